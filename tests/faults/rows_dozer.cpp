// SPDX-License-Identifier: Apache-2.0
// Rows that only the dozer has, or has in its own way.

#include <algorithm>
#include <cmath>

#include "tests/faults/row.hpp"

namespace graben::faults {
namespace {

std::size_t any_track(Trial<Dozer>& trial) { return trial.any_of(kTrackCount); }

/// A pump's servo stays where it is, or its feedback does: what it is told next it does not reach,
/// or does not seem to.
void displacement_stuck(Trial<Dozer>& trial) {
  trial.work();
  Rig<Dozer>& rig = *trial.rig;
  const std::size_t track = any_track(trial);
  plant::PathFaults& path = rig.plant.faults().path[track];
  const double ratio = rig.plant.plant().pump_ratios()[track];
  Stop stop{rig.at_us(), {Fault::kDisplacementDisagrees}};
  // When it is told another one: from one slope of the design to the next.
  stop.detect_us = Dozer::kOpensWithin_us;
  if (trial.odd()) {
    path.shown_pump_ratio = ratio;
    stop.cure = [&path] { path.shown_pump_ratio.reset(); };
  } else {
    path.pump.held_ratio = ratio;
    stop.cure = [&path] { path.pump.held_ratio.reset(); };
  }
  trial.expect_stop(stop);
}

/// Both pumps stay where they are as the operator lets go, and say that they are at 0.
void drives_on_after_the_stop(Trial<Dozer>& trial) {
  constexpr double kMostWay_m = 0.7;
  trial.work();
  Rig<Dozer>& rig = *trial.rig;
  for (unsigned i = 0; i < kTrackCount; ++i) {
    plant::PathFaults& path = rig.plant.faults().path[i];
    path.pump.held_ratio = rig.plant.plant().pump_ratios()[i];
    path.shown_pump_ratio = 0.0;
  }
  rig.ask(false, Task::kNone);
  rig.run(2 * kCycle_us);
  const TimeUs stopped_us = rig.now_us;
  const double from_m = rig.plant.plant().position_m();
  const bool brakes = rig.run_until(
      4 * kSecondUs, [&rig, stopped_us] { return rig.record.first_brake_us(stopped_us) >= 0; });
  trial.check(brakes, "does not ask for its brake");
  trial.outcome.to_detection_us = rig.now_us - stopped_us;
  rig.run(2 * kSecondUs);
  trial.outcome.harm = std::abs(rig.plant.plant().position_m() - from_m);
  trial.outcome.harm_unit = "m";
  trial.check(trial.outcome.harm <= kMostWay_m,
              "drives on by " + std::to_string(trial.outcome.harm) + " m");
  trial.saw("N");
  for (plant::PathFaults& path : rig.plant.faults().path) {
    path.pump.held_ratio.reset();
    path.shown_pump_ratio.reset();
  }
  rig.run(2 * kSecondUs);
  trial.expect_arms_again();
}

constexpr double kNearFull = 0.6;
/// What a displacement was told within the time to settle is where it may be.
constexpr TimeUs kSettled_us = 600 * kMillisecondUs;

/// A pump's or motor's servo goes somewhere else; or a pump's counts the wrong way round.
void displacement_runs_away(Trial<Dozer>& trial) {
  trial.work();
  Rig<Dozer>& rig = *trial.rig;
  const std::size_t track = any_track(trial);
  plant::PathFaults& path = rig.plant.faults().path[track];
  trial.check(rig.run_until(Dozer::kOpensWithin_us,
                            [&, cycles = 0]() mutable {
                              cycles = rig.outputs().motor_ratio[track] == 1.0 ? cycles + 1 : 0;
                              return cycles * kCycle_us > kSettled_us;
                            }),
              "the motor never stays at full displacement");
  Stop stop{rig.at_us(), {Fault::kDisplacementRunaway}, 400 * kMillisecondUs};
  stop.brake_at_once = true;
  stop.cure = [&path] {
    path.pump = {};
    path.motor = {};
  };
  switch (trial.seed() % 4) {
    case 0:
      path.pump.reversed = true;
      break;
    case 1:
      // What it is near to already is no runaway.
      path.pump.held_ratio = rig.outputs().pump_ratio[track] < kNearFull ? 1.0 : 0.0;
      break;
    case 2:
      path.pump.held_ratio = -1.0;
      break;
    default:
      path.motor.held_ratio = rig.machine.profile.hst.motor_ratio_min;
      break;
  }
  trial.expect_stop(stop);
}

/// A track's sensor shows another speed.
void track_speed_wrong(Trial<Dozer>& trial) {
  trial.work();
  Rig<Dozer>& rig = *trial.rig;
  plant::PathFaults& path = rig.plant.faults().path[any_track(trial)];
  const double way = trial.any_of(2) == 0 ? 1.0 : -1.0;
  path.speed.jump = way * (0.8 + 0.6 * trial.random.uniform());
  Slowing slowing{rig.at_us(), Fault::kTrackSpeedDisagrees, kSecondUs};
  slowing.cure = [&path] { path.speed = {}; };
  trial.expect_slower(slowing);
}

/// A slope that the blade cannot reach down to before the body tips into it, driven so slowly that
/// neither flow nor what lies ahead holds the machine.
void runs_at_its_end(Trial<Dozer>& trial) {
  Dozer::Scenery scenery = Dozer::scenery_of(trial.seed());
  DozerProfile& profile = scenery.machine.profile;
  profile.travel.speed_desired_mps = 0.3 + 0.1 * trial.random.uniform();
  profile.grade.count = 3;
  profile.grade.point[0] = {0.0, 0.0};
  profile.grade.point[1] = {2.0, 0.0};
  profile.grade.point[2] = {5.0, -0.9 - 0.2 * trial.random.uniform()};
  trial.set_up(scenery);
  expect_slowed_at_end(trial, 20 * kSecondUs, scenery.machine.plant.implement_relief_pa,
                       [](const Dozer::Plant& plant) {
                         return AtEnd{Dozer::longest_m(plant)[0] - plant.blade_stroke_m(),
                                      std::max(plant.cylinder().cap().pressure_pa(),
                                               plant.cylinder().rod().pressure_pa())};
                       });
}

}  // namespace

Rows<Dozer> dozer_rows() {
  return {{5, "pressure sensor times out", "not of this machine: none is used", nullptr},
          {37, "pressure stuck or at its rail", "not of this machine: none is used", nullptr},
          {38, "displacement does not follow", "N L", displacement_stuck},
          {39, "displacement runs away, wrong direction", "N L", displacement_runs_away},
          {40, "track speed disagrees", "D", track_speed_wrong},
          {49, "cylinder runs towards its end stop", "D", runs_at_its_end},
          {81, "pumps stay open after the stop, unseen", "N", drives_on_after_the_stop}};
}

}  // namespace graben::faults
