// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "firmware/excavator/inputs/inputs.hpp"

namespace graben {

void guard_tried_duties(DriveRows drives, const Cycle& cycle, const LastCommands<kDriveCount>& last,
                        ExcavatorValid& valid, InputState& state) {
  state.tried_ratio = {};
  const bool tries = valid.task == Task::kCommission;
  const bool under_way = state.watch.drives.tried_s > 0.0;
  if (!last.moving || !(tries || under_way)) {
    for (CommissionState& drive : state.commission) {
      rest_commission(drive);
    }
    return;
  }
  // What is lost or wrong could not be told from what the drives do, and a duty is no speed that
  // somebody outside could limit.
  const bool may = tries && valid.degraded.empty() && valid.speed_override_ratio > 0.0 &&
                   valid.external.speed_ratio >= 1.0;
  const auto& sent = last.duty_ratio;
  const auto driven = kDriveCount - std::count(sent.begin(), sent.end(), 0.0);
  const auto& tried = valid.tried_ratio;
  const bool links_rest = tried[kBoom] == 0.0 && tried[kArm] == 0.0 && tried[kBucket] == 0.0;
  FaultSet stops;
  for (int i = 0; i < drives.count(); ++i) {
    const auto k = static_cast<unsigned>(i);
    CommissionAsk ask;
    ask.sent_ratio = sent[k];
    ask.alone = driven == (sent[k] == 0.0 ? 0 : 1);
    if (tries && i < kAxisCount) {
      ask.wanted_ratio = may ? valid.tried_ratio[k] : 0.0;
      ask.window = valid.window[k];
    } else if (tries) {
      // The swing's lever says its duty, while no other is tried. Its window is its own range: what
      // sector of that it may turn in is kept by who leads it.
      ask.wanted_ratio = may && links_rest ? valid.lever_ratio[k] : 0.0;
      ask.window = {drives[i].least_travel_m, drives[i].most_travel_m, drives[i].watch.fastest_mps};
    }
    const CommissionResult result =
        next_commission(drives[i], ask, valid.drive[k], cycle.elapsed_s, state.commission[k]);
    state.tried_ratio[k] = result.duty_ratio;
    stops.add(result.fault);
  }
  if (valid.fault == Fault::kNone) {
    stop(stops, valid);
  }
}

Limit tried_limit(DriveRows drives, const std::array<CommissionState, kDriveCount>& commission) {
  for (int i = 0; i < drives.count(); ++i) {
    if (commission[static_cast<unsigned>(i)].held_side != 0) {
      return drives[i].control.at_end;
    }
  }
  return {};
}

}  // namespace graben
