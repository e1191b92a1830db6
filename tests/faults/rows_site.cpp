// SPDX-License-Identifier: Apache-2.0
// Row 94: the tracks move under a design.

#include "tests/faults/row.hpp"

namespace graben::faults {
namespace {

TaskBook level_under(const plant::ExcavatorPlant& machine) {
  DesignPlane plane;
  plane.through_m = machine.teeth().position_m;
  TaskBook book;
  book.count = 1;
  book.program[0].fences.count = 1;
  book.program[0].fences.fence[0] = plane.fence();
  return book;
}

/// By the levers on a design of a task without steps, which the operator says that he has driven
/// away from, with the deadman held: nothing follows that design any more, the fault is named, and
/// the machine goes on by its levers.
void tracks_moved(Trial<Excavator>& trial) {
  Excavator::Scenery scenery = Excavator::scenery_of(trial.seed());
  scenery.machine.plant.soil.reset();
  scenery.start_strokes_m << 0.7, 0.7, 0.5;
  trial.set_up(scenery);
  auto& rig = *trial.rig;
  rig.ecu.emplace(ExcavatorSetup(rig.machine.profile, level_under(rig.plant.plant())),
                  rig.machine.hash, rig.ecu_port, Excavator::table(rig.machine));
  plant::OperatorHands hands;
  rig.driver.set_hands(hands);
  trial.arm();
  rig.ask(true, Task::kAssist);
  rig.run(500 * kMillisecondUs);
  trial.check(rig.mode() == EcuMode::kActive, "the task does not begin");
  trial.check(rig.outputs().status.assist == AssistState::kNear, "it is not near its design");
  hands.lever_ratio[kArm] = trial.odd() ? 0.3 : -0.3;
  rig.driver.set_hands(hands);
  rig.run(trial.any_time(200 * kMillisecondUs, 600 * kMillisecondUs));
  trial.check(rig.outputs().status.assist == AssistState::kHolds, "it does not hold its design");
  rig.driver.touch(dbc::excavator::TouchedPoint::Kind::kMoved);
  // A stream is believed from its second frame on: two periods of the touch, and two cycles.
  constexpr TimeUs kSaid_us = 250 * kMillisecondUs;
  rig.run_until(kSaid_us, [&] { return rig.outputs().status.faults.has(Fault::kFrameUnknown); });
  trial.check(rig.outputs().status.faults.has(Fault::kFrameUnknown), "it is not named");
  trial.check(rig.outputs().status.assist == AssistState::kAway, "it holds its design on");
  trial.check(rig.mode() == EcuMode::kActive, "the levers' task ends");
  trial.outcome.codes.add(Fault::kFrameUnknown);
  trial.saw("W");
}

}  // namespace

Rows<Excavator> site_rows(const Excavator&) {
  return {{94, "the tracks move under a design", "W", tracks_moved}};
}

Rows<Dozer> site_rows(const Dozer&) {
  return {{94, "the tracks move under a design", "a dozer's pose is measured", nullptr}};
}

}  // namespace graben::faults
