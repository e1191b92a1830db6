// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "firmware/excavator/excavator_controller.hpp"

namespace graben {

void ExcavatorController::guard_commission(const Cycle& cycle, ExcavatorValid& valid) {
  memory_.tried_ratio = {};
  const bool tries = valid.task == Task::kCommission;
  const bool under_way = memory_.watch.drives.tried_s > 0.0;
  if (!memory_.last.moving || !(tries || under_way)) {
    for (CommissionState& state : memory_.commission) {
      rest_commission(state);
    }
    return;
  }
  // What is lost or wrong could not be told from what the drives do.
  const bool may = tries && valid.degraded.empty() && valid.speed_override_ratio > 0.0;
  const auto& sent = memory_.last.duty_ratio;
  const auto driven = kDriveCount - std::count(sent.begin(), sent.end(), 0.0);
  FaultSet stops;
  for (int i = 0; i < drives().count(); ++i) {
    const auto k = static_cast<unsigned>(i);
    CommissionAsk ask;
    ask.sent_ratio = sent[k];
    ask.alone = driven == (sent[k] == 0.0 ? 0 : 1);
    if (tries && i < kAxisCount) {
      ask.wanted_ratio = may ? valid.tried_ratio[k] : 0.0;
      ask.window = valid.window[k];
    }
    const CommissionResult result =
        next_commission(drives()[i], ask, valid.drive[k], cycle.elapsed_s, memory_.commission[k]);
    memory_.tried_ratio[k] = result.duty_ratio;
    stops.add(result.fault);
  }
  if (valid.fault == Fault::kNone) {
    stop(stops, valid);
  }
}

Limit ExcavatorController::commission_limit() const {
  for (int i = 0; i < kAxisCount; ++i) {
    if (memory_.commission[static_cast<unsigned>(i)].held_side != 0) {
      return drives()[i].control.at_end;
    }
  }
  return {};
}

GateResult ExcavatorController::gate(const Motion& motion, bool active, const McvPoint& point,
                                     double period_s, ExcavatorOutputs& outputs) {
  return motion.tries ? gate_duties(drives(), active, memory_.tried_ratio, period_s,
                                    memory_.opening, outputs.duty_ratio)
                      : gate_drives(drives(), active, point.spool_m, period_s, memory_.opening,
                                    outputs.duty_ratio);
}

}  // namespace graben
