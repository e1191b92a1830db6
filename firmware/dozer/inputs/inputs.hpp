// SPDX-License-Identifier: Apache-2.0
#pragma once
/// First stage of a dozer's cycle: from signals to what may be used of them, with every fault that
/// they show.

#include "firmware/dozer/safety/travel_guard.hpp"
#include "firmware/dozer/stage.hpp"
#include "firmware/drives/commission_guard.hpp"
#include "firmware/safety/cycle.hpp"
#include "firmware/safety/external_limit.hpp"
#include "firmware/safety/task_change.hpp"

namespace graben {

/// State from cycle to cycle.
struct DozerInputState {
  DozerValidationState validation;
  DozerWatchState watch;
  TaskChangeState change;
  ExternalState external;
  std::array<CommissionState, kBladeCount> commission;
  TravelGuardState travel;
  TriedCommand tried;  ///< Of this cycle, as far as it may be sent.
};

/// Guards what is tried while a machine is commissioned, of which nothing is known, and gives what
/// of it may be sent in `state.tried`. What a drive does wrong stops, where nothing else does.
void guard_tried(const DozerModel& machine, const Cycle& cycle, const DozerLastCycle& last,
                 DozerValid& valid, DozerInputState& state);

/// Signals validated and watched against what the last cycle commanded, and the task as it may be
/// followed: a change of it passes standstill.
[[nodiscard]] DozerValid read_inputs(const DozerModel& machine, const DozerInputs& inputs,
                                     const Cycle& cycle, TimeUs now_us, const DozerLastCycle& last,
                                     DozerInputState& state);

}  // namespace graben
