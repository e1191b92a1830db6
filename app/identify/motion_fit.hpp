// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Identification of a machine from recorded motion, with Ceres.

#include <functional>
#include <string>
#include <vector>

#include "app/identify/motion_model.hpp"

namespace graben::identify {

struct FitOptions {
  int threads = 2;
  int passes = 3;  ///< Over all joints: each needs the others' openings.
  /// A share of the work done, 0 .. 1, and where it is.
  std::function<void(double, const std::string&)> progress = [](double, const std::string&) {};
};

/// Fits a model to runs: smallest robust error of the velocities. Dead times are searched from
/// several starts; curves rise or stay, as no rise may be negative. A joint that stands throughout
/// keeps no opening. Throws std::runtime_error where no joint moves.
[[nodiscard]] MotionModel fit_motion(const std::vector<MotionRun>& runs, const FitOptions& options);

}  // namespace graben::identify
