// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What Ceres is to make small: both equations of valve_model.hpp at a point, and how far a value
/// is from what was known before.

#include <array>
#include <cmath>
#include <cstddef>

#include "app/identify/machine/valve_model.hpp"

namespace graben::identify {

// A side's block, a drive's and a pump's; sizes are the cost function's.
enum SideParameter : std::size_t {
  kEdge,
  kLogSoftness,
  kExponent,
  kLogCoefficient,
  kLogOutArea,
  kSideSize
};
inline constexpr std::size_t kZeroSize = 2;  ///< Cap, rod, MPa.
/// The regulators' block: logarithms of closes_at_factor and felt_factor.
inline constexpr std::size_t kRegulatorSize = 2;
inline constexpr double kPaPerMpa = 1e6;

inline ValveTry try_of(const double* side, const double* zero, const double* pump,
                       const double* regulator = nullptr) {
  ValveTry tried;
  tried.curve = {side[kEdge], std::exp(side[kLogSoftness]), side[kExponent]};
  tried.coefficient_factor = std::exp(side[kLogCoefficient]);
  tried.out_area_factor = std::exp(side[kLogOutArea]);
  tried.cap_zero_pa = kPaPerMpa * zero[0];
  tried.rod_zero_pa = kPaPerMpa * zero[1];
  tried.pump_flow_factor = pump[0];
  if (regulator != nullptr) {
    tried.closes_at_factor = std::exp(regulator[0]);
    tried.felt_factor = std::exp(regulator[1]);
  }
  return tried;
}

/// What is left open of a point's speed, by each equation, m/s.
struct PointSpread {
  double speed_mps = 1.0;
  double out_mps = 1.0;
};

class PointCost {
 public:
  PointCost(const PreparedPoint* point, const PointSpread* its_spread)
      : of(point), spread(its_spread) {}

  bool operator()(const double* side, const double* zero, const double* pump,
                  double* residuals) const {
    return tell(try_of(side, zero, pump), residuals);
  }
  /// With negative flow.
  bool operator()(const double* side, const double* zero, const double* pump,
                  const double* regulator, double* residuals) const {
    return tell(try_of(side, zero, pump, regulator), residuals);
  }

 private:
  bool tell(const ValveTry& tried, double* residuals) const {
    residuals[0] = of->says_speed() ? of->speed_error(tried).error_mps / spread->speed_mps : 0.0;
    residuals[1] = of->drains() ? of->out_error_mps(tried) / spread->out_mps : 0.0;
    return true;
  }

  const PreparedPoint* of;
  const PointSpread* spread;
};

/// One value about its mean.
struct PriorCost {
  std::size_t at;
  double mean;
  double deviation;

  bool operator()(const double* block, double* residual) const {
    residual[0] = (block[at] - mean) / deviation;
    return true;
  }
};

}  // namespace graben::identify
