// SPDX-License-Identifier: Apache-2.0
// Rows 74, 75 and 89: tasks that go by the operator's hands, of an excavator.

#include <algorithm>
#include <cmath>
#include <optional>

#include "app/runs/frame_edit.hpp"
#include "tests/faults/row.hpp"

namespace graben::faults {
namespace {

constexpr double kWindow_m = 0.25;
constexpr double kFast_mps = 0.5;

/// From power-on to one of these tasks, on a machine that stands free, with the hands at rest.
/// `alike`: boom and arm are as far extended, so that none shows a jump that is not its own.
plant::OperatorHands begin_by_hand(Trial<Excavator>& trial, Task task, bool alike = false,
                                   double levers_alive_s = 0.0) {
  Excavator::Scenery scenery = Excavator::scenery_of(trial.seed());
  scenery.machine.plant.soil.reset();
  scenery.machine.profile.safety.levers_alive_s = levers_alive_s;
  if (alike) {
    scenery.start_strokes_m << 0.7, 0.7, 0.5;
  }
  trial.set_up(scenery);
  auto& rig = *trial.rig;
  plant::OperatorHands hands;
  for (unsigned axis = 0; axis < kAxisCount; ++axis) {
    const double stroke_m = rig.plant.plant().strokes_m()[axis];
    const double most_m = Excavator::longest_m(rig.plant.plant())[axis];
    hands.window[axis] = StrokeWindow{std::max(stroke_m - kWindow_m, 0.0),
                                      std::min(stroke_m + kWindow_m, most_m), kFast_mps};
  }
  rig.driver.set_hands(hands);
  trial.arm();
  rig.ask(true, task);
  rig.run(200 * kMillisecondUs);
  trial.check(rig.mode() == EcuMode::kActive, "the task does not begin");
  return hands;
}

/// The station sends all but what its hands do.
void hands_silent(Trial<Excavator>& trial) {
  constexpr std::array<Task, 4> kTasks = {Task::kJog, Task::kAssist, Task::kCoordinated,
                                          Task::kCommission};
  const Task task = kTasks[trial.seed() % kTasks.size()];
  plant::OperatorHands hands = begin_by_hand(trial, task);
  auto& rig = *trial.rig;
  const bool tries = task == Task::kCommission;
  (tries ? hands.tried_ratio[kArm] : hands.lever_ratio[kArm]) = trial.odd() ? 0.4 : -0.4;
  rig.driver.set_hands(hands);
  rig.run(trial.any_time(200 * kMillisecondUs, 800 * kMillisecondUs));
  trial.check(rig.mode() == EcuMode::kActive, "it does not work");
  const std::uint32_t id =
      tries ? dbc::excavator::CommissionDuty::kId : dbc::excavator::OperatorAxes::kId;
  Stop stop{trial.last_us(id), {Fault::kOperatorMissing}, kSilence_us};
  stop.cure = [&rig, id] {
    rig.driver.faults().set_silent(id, false);
    rig.driver.set_hands({});
  };
  rig.driver.faults().set_silent(id, true);
  trial.expect_stop(stop);
}

/// What reads the levers hangs, what sends them goes on: the same for good, under a counter, a
/// checksum and a deadman that live.
void hands_frozen(Trial<Excavator>& trial) {
  constexpr double kAlive_s = 0.1;
  const Task task = trial.odd() ? Task::kJog : Task::kCoordinated;
  plant::OperatorHands hands = begin_by_hand(trial, task, false, kAlive_s);
  auto& rig = *trial.rig;
  // Also at its end, where a lever stands by itself.
  const double lever = trial.any_of(2) == 0 ? 1.0 : 0.4;
  hands.lever_ratio[kArm] = trial.any_of(2) == 0 ? lever : -lever;
  hands.alive = true;
  rig.driver.set_hands(hands);
  rig.run(trial.any_time(200 * kMillisecondUs, 800 * kMillisecondUs));
  trial.check(rig.mode() == EcuMode::kActive, "it does not work");
  std::optional<CanFrame> kept;
  rig.tamper = [&kept](CanFrame& frame, const LoopbackPort*) {
    if (frame.id == dbc::excavator::OperatorAxes::kId) {
      kept = kept ? kept : std::optional<CanFrame>(frame);
      const std::uint8_t counter = runs::counter_of(frame);
      frame.data = kept->data;
      runs::protect<Excavator>(frame, counter);
    }
    return true;
  };
  constexpr TimeUs kSeen_us = 160 * kMillisecondUs;  // kAlive_s, two frames and a cycle.
  Stop stop{rig.at_us(), {Fault::kOperatorMissing}, kSeen_us};
  stop.cure = [&rig] {
    rig.tamper = nullptr;
    rig.driver.set_hands({});
  };
  trial.expect_stop(stop);
}

/// What commissioning comes upon: a reversed valve, two sensors changed over; what its station must
/// not ask for: more speed than was confirmed, three drives at once.
void commissioning_fails(Trial<Excavator>& trial) {
  const unsigned kind = static_cast<unsigned>(trial.seed() % 4);
  plant::OperatorHands hands = begin_by_hand(trial, Task::kCommission, kind == 1);
  auto& rig = *trial.rig;
  const unsigned axis = trial.any_of(kind == 1 ? 2 : kAxisCount);
  const double side = trial.any_of(2) == 0 ? 1.0 : -1.0;
  constexpr std::array<Fault, 4> kExpected = {Fault::kWrongDirection, Fault::kUncommandedMotion,
                                              Fault::kCommissionBound, Fault::kCommissionBound};
  rig.plant.faults().axis[axis].reversed = kind == 0;
  if (kind == 1) {
    rig.plant.faults().stroke_from = {1, 0, 2};
  }
  if (kind == 2) {
    hands.window[axis]->most_mps = 0.01;
  }
  hands.tried_ratio.fill(kind == 3 ? 0.3 : 0.0);
  hands.tried_ratio[axis] = side * 0.5;
  rig.driver.set_hands(hands);
  const auto from_m = rig.plant.plant().strokes_m();
  double most_m = 0.0;
  const bool stopped = rig.run_until(15 * kSecondUs, [&] {
    const auto at_m = rig.plant.plant().strokes_m();
    for (unsigned i = 0; i < kAxisCount; ++i) {
      most_m = std::max(most_m, std::abs(at_m[i] - from_m[i]));
    }
    return !in_motion(rig.mode());
  });
  const Fault fault = rig.outputs().status.fault;
  trial.check(stopped && fault == kExpected[kind],
              "fault " + std::to_string(static_cast<int>(fault)));
  trial.outcome.codes.add(fault);
  trial.outcome.harm = most_m;
  trial.outcome.harm_unit = "m stroke";
  constexpr double kMost_m = 0.05;
  trial.check(most_m <= kMost_m, std::to_string(1e3 * most_m) + " mm of stroke");
  const TimeUs stopped_us = rig.at_us();
  rig.run(500 * kMillisecondUs);
  trial.check(rig.record.all_neutral(stopped_us + 2 * kCycle_us), "not neutral");
  trial.saw("N L");
}

}  // namespace

Rows<Excavator> hand_rows(const Excavator&) {
  return {{74, "levers, or duties to try, silent", "N L", hands_silent},
          {75, "commissioning: reversed, swapped, too fast, too many", "N L", commissioning_fails},
          {89, "levers frozen under a live counter, their station alive", "N L", hands_frozen}};
}

}  // namespace graben::faults
