// SPDX-License-Identifier: Apache-2.0
// What Task::kCommission tries: one drive at a time, within its window.
#include "firmware/dozer/inputs/inputs.hpp"

namespace graben {
namespace {

/// Duty of the blade's drive `i` that is asked for.
double asked_ratio(const DozerTry& tried, unsigned i) {
  const TriedDrive drive = i == kBladeLift ? TriedDrive::kLift : TriedDrive::kTilt;
  return tried.drive == drive ? tried.ratio : 0.0;
}

void guard_blade(const DozerModel& machine, const DozerTry& asked, double period_s,
                 const DozerLastCycle& last, const DozerValid& valid, DozerInputState& state,
                 FaultSet& stops) {
  const auto& sent = last.commands.drives.duty_ratio;
  for (int n = 0; n < machine.drives.count(); ++n) {
    const auto i = static_cast<unsigned>(n);
    CommissionAsk ask;
    ask.sent_ratio = sent[i];
    ask.wanted_ratio = asked_ratio(asked, i);
    ask.window = valid.window[i];
    ask.alone = sent[1 - i] == 0.0;
    const CommissionResult result =
        next_commission(machine.drives[n], ask, valid.drive[i], period_s, state.commission[i]);
    state.tried.duty_ratio[i] = result.duty_ratio;
    if (result.held) {
      state.tried.limit = machine.drives[n].control.at_end;
    }
    stops.add(result.fault);
  }
}

}  // namespace

void guard_tried(const DozerModel& machine, const Cycle& cycle, const DozerLastCycle& last,
                 DozerValid& valid, DozerInputState& state) {
  state.tried = {};
  state.tried.tries = valid.task == Task::kCommission;
  const bool under_way = state.watch.drives.tried_s > 0.0;
  if (!last.commands.drives.moving || !(state.tried.tries || under_way)) {
    for (CommissionState& drive : state.commission) {
      rest_commission(drive);
    }
    // By hand, or by another task, it goes where nobody has confirmed anything.
    rest_travel(valid.by_hand() || last.commands.drives.moving, state.travel);
    return;
  }
  // What is lost or wrong could not be told from what the drives do, and a duty is no speed that
  // somebody outside could limit.
  const bool may = state.tried.tries && valid.degraded.empty() &&
                   valid.speed_override_ratio > 0.0 && valid.external.speed_ratio >= 1.0;
  const DozerTry asked = may ? valid.tried : DozerTry{};
  FaultSet stops;
  guard_blade(machine, asked, cycle.elapsed_s, last, valid, state, stops);
  TravelAsk ask;
  ask.sent_ratio = last.commands.ratios.pump[kLeft];
  ask.wanted_ratio = asked.drive == TriedDrive::kTracks ? asked.ratio : 0.0;
  ask.window = valid.window[kTriedCount - 1];
  const TravelGuardResult travel = next_travel(ask, valid, cycle.elapsed_s, state.travel);
  stops.add(travel.fault);
  state.tried.pump_ratio = travel.pump_ratio;
  state.tried.motor_ratio = travel.pump_ratio == 0.0 ? 1.0 : asked.motor_ratio;
  if (valid.fault == Fault::kNone) {
    stop(stops, valid);
  }
}

}  // namespace graben
