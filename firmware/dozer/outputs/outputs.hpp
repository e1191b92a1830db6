// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Fifth stage of a dozer's cycle: duties and displacements, through the gate, and the brake.

#include "firmware/dozer/limits/limits.hpp"
#include "firmware/dozer/safety/dozer_gate.hpp"
#include "firmware/dozer/travel/tracks.hpp"

namespace graben {

/// State from cycle to cycle.
struct DozerOutputState {
  std::array<TrackState, kTrackCount> track{};
  DozerGateState gate;
  BrakeState brake;
};

/// All that leaves the core for the machine. What the gate refuses ends `decision`'s motion.
/// `tried` takes the place of motion and travel where its task is followed.
void put_out(const DozerModel& machine, const DozerValid& valid, const BladeMotion& motion,
             const Travel& travel, const TriedCommand& tried, double period_s,
             ModeDecision& decision, DozerOutputState& state, DozerOutputs& outputs);

}  // namespace graben
