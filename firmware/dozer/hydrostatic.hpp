#pragma once
/// The hydrostatic transmission in steady state (9), its inverse, and the limits of its ratios.

#include "firmware/dozer/dozer_profile.hpp"

namespace graben {

/// Displacement ratios of one path: epsilon_p in -1 .. 1, epsilon_m in motor_ratio_min .. 1.
struct Displacements {
  double pump_ratio = 0.0;
  double motor_ratio = 1.0;
};

/// Track speed u_j r of (9): what the displacements give at this engine speed, m/s. 0 for a motor
/// ratio that is not above 0.
[[nodiscard]] double track_speed_mps(const HstProfile& hst, double engine_radps, double pump_ratio,
                                     double motor_ratio);

/// Fastest track speed at this engine speed: epsilon_p = 1, epsilon_m = epsilon_m,min.
[[nodiscard]] double track_speed_max_mps(const HstProfile& hst, double engine_radps);

/// The inverse of (9): the pump first with the motor at full displacement, which gives the most
/// torque, then the motor. A speed beyond the fastest gets the fastest; without engine speed the
/// pump is at 0.
[[nodiscard]] Displacements displacements_for(const HstProfile& hst, double engine_radps,
                                              double speed_mps);

}  // namespace graben
