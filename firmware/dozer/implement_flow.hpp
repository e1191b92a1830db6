#pragma once
/// Flow of the blade cylinders, wanted and to be had.

#include <algorithm>

#include "firmware/dozer/dozer_profile.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben {

/// Q_in of (7), m^3/s: what the cylinders take in at this velocity; extension is positive.
[[nodiscard]] inline double inflow_m3ps(const BladeGeometry& blade, double velocity_mps) {
  return velocity_mps >= 0.0 ? blade.cap_area_m2() * velocity_mps
                             : -blade.rod_area_m2() * velocity_mps;
}

/// Opening -1 .. 1 of the valve's full flow that gives this velocity while the pump can feed it.
[[nodiscard]] inline double opening_for(const DozerProfile& profile, double velocity_mps) {
  const double share =
      inflow_m3ps(profile.blade, velocity_mps) / profile.implement.valve_flow_max_m3ps;
  return std::clamp(velocity_mps < 0.0 ? -share : share, -1.0, 1.0);
}

/// min(Q_max,imp, Q_max,valve) of (11) with (12), m^3/s.
[[nodiscard]] inline double available_flow_m3ps(const ImplementProfile& implement,
                                                double engine_radps) {
  const double pump_m3ps =
      engine_radps / kTwoPi * implement.displacement_m3prev * implement.efficiency;
  return std::clamp(pump_m3ps, 0.0, implement.valve_flow_max_m3ps);
}

}  // namespace graben
