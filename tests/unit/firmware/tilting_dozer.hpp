// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The shipped dozer whose blade tilts, and designs with a slope across.

#include <cmath>
#include <vector>

#include "app/machines/simulated/simulated_dozer.hpp"

namespace graben::test {

inline const machines::SimulatedDozer& tilting_dozer() {
  static const machines::SimulatedDozer machine =
      machines::load_simulated_dozer(machines::find_profile("dozer_9t_tilt"));
  return machine;
}

/// A slope across that begins at x = 2 m and gets more by `per_m` until it has this value, on a
/// design that is level along the track and this high. It has to outlive its design.
struct CrossDesign {
  CrossDesign(double slope, double per_m, double height_m = 0.0) {
    constexpr int kCount = 401;
    for (int i = 0; i < kCount; ++i) {
      const double x_m = i * GradeHeights::kStep_m;
      const double wanted = per_m * std::max(0.0, x_m - 2.0);
      heights.push_back(height_m);
      cross.push_back(std::copysign(std::min(std::abs(wanted), std::abs(slope)), slope));
    }
    grade = tilting_dozer().profile.grade;
    grade.count = 0;
    grade.heights = {heights.data(), cross.data(), kCount, 0.0};
  }
  CrossDesign(const CrossDesign&) = delete;
  CrossDesign& operator=(const CrossDesign&) = delete;

  std::vector<double> heights;
  std::vector<double> cross;
  GradeDesign grade;
};

/// The machine on it.
inline DozerProfile on(const CrossDesign& design) {
  DozerProfile profile = tilting_dozer().profile;
  profile.grade = design.grade;
  return profile;
}

}  // namespace graben::test
