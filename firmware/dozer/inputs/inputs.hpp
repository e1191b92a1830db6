// SPDX-License-Identifier: Apache-2.0
#pragma once
/// First stage of a dozer's cycle: from signals to what may be used of them, with every fault that
/// they show.

#include "firmware/dozer/stage.hpp"
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
};

/// Signals validated and watched against what the last cycle commanded, and the task as it may be
/// followed: a change of it passes standstill.
[[nodiscard]] DozerValid read_inputs(const DozerModel& machine, const DozerInputs& inputs,
                                     const Cycle& cycle, TimeUs now_us, const DozerLastCycle& last,
                                     DozerInputState& state);

}  // namespace graben
