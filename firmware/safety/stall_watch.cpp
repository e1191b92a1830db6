// SPDX-License-Identifier: Apache-2.0
#include "firmware/safety/stall_watch.hpp"

#include <algorithm>

#include "firmware/safety/tuning.hpp"

namespace graben {

void tell_stall(const StallState& state, double most_s, CommonValid& inputs) {
  if (state.stalled_s > most_s) {
    FaultSet stalled;
    stalled.add(Fault::kStalled);
    stop(stalled, inputs);
  } else if (state.stalled_s > kStallSaid_s) {
    warn(Fault::kStalling, inputs);
  }
}

void next_stall(bool active, bool asked, double share, double most_s, double period_s,
                StallState& state) {
  if (!active) {
    state = {};
    return;
  }
  // What is not a number does not get on.
  const bool gets_on = !asked || share >= kStallShare;
  const double change_s = gets_on ? -period_s : period_s;
  state.stalled_s = std::clamp(state.stalled_s + change_s, 0.0, most_s + 1.0);
}

}  // namespace graben
