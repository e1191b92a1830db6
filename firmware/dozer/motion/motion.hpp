// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Third stage of a dozer's cycle: what lift and tilt are to do to keep the edge on the design, and
/// what the pump makes of it.

#include "firmware/dozer/estimation/situation.hpp"

namespace graben {

/// State from cycle to cycle.
struct BladeMotionState {
  BladeState blade;
  TiltState tilt;
};

/// What one cycle asks of the blade.
struct BladeMotion {
  BladeCommand blade;
  TiltCommand tilt;
  std::array<double, kBladeCount> opening{};  ///< Lift and tilt, see DozerCommand.
  double required_flow_m3ps = 0.0;
  double available_flow_m3ps = 0.0;
  std::array<double, kBladeCount> asked_mps{};  ///< Of lift and tilt, as far as the flow goes.
  bool fed = true;                              ///< The pump gives what both ask for.

  /// Off where it is meant to be, the end of the edge that is further.
  [[nodiscard]] double off_m(const DozerModel& machine) const {
    return std::abs(blade.off_m) + at_ends_m(machine, tilt.error);
  }
};

/// Of the error that the task allows, what the blade may leave standing on purpose: the rest is for
/// what nobody foresees.
[[nodiscard]] double lift_most_m(const DozerProfile& profile);

/// Both drives' velocities; the pump shares its flow between them as they ask for it.
[[nodiscard]] BladeMotion wanted_motion(const DozerModel& machine, const DozerValid& valid,
                                        const DozerEstimates& estimates, const Preview& preview,
                                        double period_s, const DozerLastCycle& last,
                                        const BladeMotionState& state);

/// After a cycle. Out of motion nothing is kept.
void go_on(const BladeMotion& motion, bool active, BladeMotionState& state);

}  // namespace graben
