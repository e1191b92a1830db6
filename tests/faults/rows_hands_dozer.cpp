// SPDX-License-Identifier: Apache-2.0
// Rows 74 and 75 of a dozer: its commissioning, which goes by the operator's hands.

#include <algorithm>
#include <cmath>

#include "tests/faults/row.hpp"

namespace graben::faults {
namespace {

/// From power-on to commissioning, with all windows confirmed and nothing tried.
plant::DozerHands begin_commission(Trial<Dozer>& trial) {
  trial.set_up(Dozer::scenery_of(trial.seed()));
  auto& rig = *trial.rig;
  plant::DozerHands hands;
  hands.window[0] = StrokeWindow{0.0, Dozer::longest_m(rig.plant.plant())[0], 0.4};
  hands.window[2] = StrokeWindow{-3.0, 3.0, 1.2};
  rig.driver.set_tries(hands);
  trial.arm();
  rig.ask(true, Task::kCommission);
  rig.run(300 * kMillisecondUs);
  trial.check(rig.mode() == EcuMode::kActive, "the task does not begin");
  return hands;
}

/// The station sends all but what is to be tried.
void tries_silent(Trial<Dozer>& trial) {
  plant::DozerHands hands = begin_commission(trial);
  auto& rig = *trial.rig;
  hands.tried =
      trial.odd() ? DozerTry{TriedDrive::kLift, -0.4} : DozerTry{TriedDrive::kTracks, 0.4};
  rig.driver.set_tries(hands);
  rig.run(trial.any_time(200 * kMillisecondUs, 800 * kMillisecondUs));
  trial.check(rig.mode() == EcuMode::kActive, "it does not work");
  constexpr std::uint32_t kId = dbc::dozer::DozerTry::kId;
  Stop stop{trial.last_us(kId), {Fault::kOperatorMissing}, kSilence_us};
  stop.cure = [&rig] {
    rig.driver.faults().set_silent(kId, false);
    rig.driver.set_tries({});
  };
  rig.driver.faults().set_silent(kId, true);
  trial.expect_stop(stop);
}

/// What is wrong with the machine, or with what its station asks for.
enum class Wrong { kValve, kBladeFast, kTracksFast, kPumps };

/// A reversed valve, reversed pumps; more speed than was confirmed, of the blade and of the tracks.
void dozer_commissioning_fails(Trial<Dozer>& trial) {
  const auto kind = static_cast<Wrong>(trial.seed() % 4);
  plant::DozerHands hands = begin_commission(trial);
  auto& rig = *trial.rig;
  const double side = trial.any_of(2) == 0 ? 1.0 : -1.0;
  const bool tracks = kind == Wrong::kTracksFast || kind == Wrong::kPumps;
  hands.tried =
      tracks ? DozerTry{TriedDrive::kTracks, 0.5 * side} : DozerTry{TriedDrive::kLift, 0.4 * side};
  Fault expected = Fault::kCommissionBound;
  switch (kind) {
    case Wrong::kValve:
      rig.plant.faults().reversed = true;
      expected = Fault::kWrongDirection;
      break;
    case Wrong::kBladeFast:
      hands.window[0]->most_mps = 0.01;
      break;
    case Wrong::kTracksFast:
      hands.window[2]->most_mps = 0.1;
      break;
    case Wrong::kPumps:
      for (plant::PathFaults& path : rig.plant.faults().path) {
        path.pump.reversed = true;
      }
      expected = Fault::kDisplacementRunaway;
      break;
  }
  rig.run(200 * kMillisecondUs);
  rig.driver.set_tries(hands);
  const auto from_m = Dozer::places_m(rig.plant.plant());
  double most_m = 0.0;
  const bool stopped = rig.run_until(15 * kSecondUs, [&] {
    const auto at_m = Dozer::places_m(rig.plant.plant());
    const std::size_t place = tracks ? 1 : 0;
    most_m = std::max(most_m, std::abs(at_m[place] - from_m[place]));
    return !in_motion(rig.mode());
  });
  const Fault fault = rig.outputs().status.fault;
  trial.check(stopped && fault == expected, "fault " + std::to_string(static_cast<int>(fault)));
  trial.outcome.codes.add(fault);
  trial.outcome.harm = most_m;
  trial.outcome.harm_unit = tracks ? "m" : "m stroke";
  const double allowed_m = tracks ? 0.15 : 0.05;
  trial.check(most_m <= allowed_m, std::to_string(1e3 * most_m) + " mm");
  const TimeUs stopped_us = rig.at_us();
  rig.run(500 * kMillisecondUs);
  trial.check(rig.record.all_neutral(stopped_us + 2 * kCycle_us), "not neutral");
  trial.saw("N L");
}

}  // namespace

Rows<Dozer> hand_rows(const Dozer&) {
  return {{74, "duties to try, silent", "N L", tries_silent},
          {75, "commissioning: reversed valve, reversed pumps, too fast", "N L",
           dozer_commissioning_fails},
          {76, "an IMU wrong", "a dozer has no IMUs", nullptr},
          {77, "a sensor of CANopen tells an emergency", "a dozer has none", nullptr},
          {89, "levers frozen", "a dozer has no such task", nullptr},
          {90, "a gyro jumps", "a dozer has no IMUs", nullptr}};
}

}  // namespace graben::faults
