// SPDX-License-Identifier: Apache-2.0
// Commissioning of the simulated dozers over the bus: what is tried and held back, and the whole
// of it.

#include <algorithm>
#include <cmath>
#include <string>

#include "app/runs/dozer_commission_run.hpp"
#include "app/runs/dozer_rig.hpp"
#include "tests/unit/cmocka_cpp.hpp"

using namespace graben;

namespace {

machines::SimulatedDozer shipped(const char* name) {
  return machines::load_simulated_dozer(machines::find_profile(name));
}

/// A station at the dozer whose blade tilts, raised a little.
struct Bench : runs::DozerRig {
  Bench() : LoopbackRig(machine(), machine().profile, {}, Task::kCommission, 1.0) {
    hands.window[0] = StrokeWindow{0.0, 0.19, 0.4};
    hands.window[1] = StrokeWindow{0.0, 0.16, 0.4};
    hands.window[2] = StrokeWindow{-1.5, 1.5, 1.2};
    run(0.8);
    assert_int_equal(ecu->outputs().status.mode, EcuMode::kActive);
  }
  static const machines::SimulatedDozer& machine() {
    static const machines::SimulatedDozer all = shipped("dozer_9t_tilt");
    return all;
  }
  void run(double time_s) {
    for (const TimeUs end_us = now_us + static_cast<TimeUs>(1e6 * time_s);
         now_us < end_us && ecu_is_well(); now_us += kPeriod_us) {
      driver.set_tries(hands);
      static_cast<void>(step(now_us));
    }
  }
  [[nodiscard]] bool ecu_is_well() const { return ecu->outputs().status.mode != EcuMode::kFault; }
  void try_for(TriedDrive drive, double ratio, double time_s, double motor = 1.0) {
    hands.tried = {drive, ratio, motor};
    run(time_s);
  }
  [[nodiscard]] double lift_m() const { return plant.plant().blade_stroke_m(); }
  [[nodiscard]] double tilt_m() const { return plant.plant().tilt()->stroke_m(); }
  [[nodiscard]] double place_m() const { return plant.plant().position_m(); }
  [[nodiscard]] Fault fault() const { return ecu->outputs().status.fault; }

  plant::DozerHands hands;
  TimeUs now_us = 0;
};

}  // namespace

TEST(a_try_moves_its_drive_and_no_other) {
  struct Case {
    TriedDrive drive;
    double ratio;
  };
  for (const Case& of :
       {Case{TriedDrive::kLift, -0.4}, Case{TriedDrive::kTilt, 0.4}, Case{TriedDrive::kTilt, -0.4},
        Case{TriedDrive::kTracks, 0.4}, Case{TriedDrive::kTracks, -0.4}}) {
    Bench bench;
    const double before[] = {bench.lift_m(), bench.tilt_m(), bench.place_m()};
    bench.try_for(of.drive, of.ratio, 1.0);
    assert_int_equal(bench.fault(), Fault::kNone);
    const double moved[] = {bench.lift_m() - before[0], bench.tilt_m() - before[1],
                            bench.place_m() - before[2]};
    for (int drive = 0; drive < 3; ++drive) {
      if (drive + 1 == static_cast<int>(of.drive)) {
        assert_true(moved[drive] * of.ratio > 0.0 && std::abs(moved[drive]) > 0.01);
      } else {
        assert_true(std::abs(moved[drive]) < 0.002);
      }
    }
    const DozerOutputs& sent = bench.ecu->outputs();
    const double lift = of.drive == TriedDrive::kLift ? of.ratio : 0.0;
    const double tilt = of.drive == TriedDrive::kTilt ? of.ratio : 0.0;
    const double pump = of.drive == TriedDrive::kTracks ? of.ratio : 0.0;
    assert_near(sent.blade_duty_ratio, lift, 1e-4);
    assert_near(sent.tilt_duty_ratio, tilt, 1e-4);
    assert_near(sent.pump_ratio[kLeft], pump, 1e-4);
    assert_near(sent.pump_ratio[kRight], pump, 1e-4);
  }
}

TEST(motors_go_with_the_tracks_alone, Bench bench) {
  bench.try_for(TriedDrive::kTracks, 0.3, 0.8, 0.6);
  assert_near(bench.ecu->outputs().motor_ratio[kLeft], 0.6, 1e-4);
  bench.try_for(TriedDrive::kTilt, 0.3, 0.2, 0.6);
  assert_near(bench.ecu->outputs().motor_ratio[kLeft], 1.0, 0.0);
  assert_near(bench.ecu->outputs().pump_ratio[kLeft], 0.0, 0.0);
}

TEST(windows_hold_each_drive_back) {
  Bench tracks;
  const double from_m = tracks.place_m();
  tracks.try_for(TriedDrive::kTracks, 0.8, 8.0);
  assert_int_equal(tracks.fault(), Fault::kNone);
  assert_true(tracks.place_m() - from_m > 1.0 && tracks.place_m() - from_m < 1.5);
  tracks.try_for(TriedDrive::kTracks, -0.8, 12.0);
  assert_int_equal(tracks.fault(), Fault::kNone);
  assert_true(tracks.place_m() - from_m < -1.0 && tracks.place_m() - from_m > -1.5);

  Bench lift;
  lift.try_for(TriedDrive::kLift, -0.5, 4.0);
  lift.try_for(TriedDrive::kLift, 0.5, 8.0);
  assert_int_equal(lift.fault(), Fault::kNone);
  assert_true(lift.lift_m() > 0.10 && lift.lift_m() < 0.20);
}

TEST(without_its_window_a_drive_stands) {
  for (const TriedDrive drive : {TriedDrive::kLift, TriedDrive::kTilt, TriedDrive::kTracks}) {
    Bench bench;
    bench.hands.window[static_cast<std::size_t>(drive) - 1].reset();
    bench.run(1.2);
    const double before[] = {bench.lift_m(), bench.tilt_m(), bench.place_m()};
    bench.try_for(drive, -0.6, 1.5);
    assert_int_equal(bench.fault(), Fault::kNone);
    assert_near(bench.lift_m(), before[0], 0.002);
    assert_near(bench.tilt_m(), before[1], 0.002);
    assert_near(bench.place_m(), before[2], 0.01);
  }
}

/// In no other task, and while the operator's share of the speed is 0, nothing is tried.
TEST(an_override_of_nothing_holds_all, Bench bench) {
  bench.driver.set_schedule({{0, {true, OperatorMode::kAutomatic, Task::kCommission, 0.0}}});
  bench.run(0.1);
  const double from_m = bench.place_m();
  bench.try_for(TriedDrive::kTracks, 0.5, 1.0);
  assert_int_equal(bench.fault(), Fault::kNone);
  assert_near(bench.place_m(), from_m, 0.01);
}

TEST(all_of_it_within_five_minutes) {
  for (const char* const name : {"dozer_9t", "dozer_9t_tilt"}) {
    machines::SimulatedDozer machine = shipped(name);
    machine.plant.sensor_errors = true;
    machine.plant.seed = 3;
    const commission::DozerOptions options = commission::whole_dozer(machine.profile);
    const runs::CommissionResult result = runs::run_dozer_commission(
        machine, options, {}, nullptr, [](double, const std::string&) {});
    assert_int_equal(result.end, runs::CommissionEnd::kDone);
    assert_int_equal(result.steps.size(), commission::dozer_step_texts(options).size());
    print_message("%s: %.0f s\n", name, result.machine_s);
    assert_true(result.machine_s < 150.0);
    for (const commission::StepResult& step : result.steps) {
      assert_true(step.end == commission::StepEnd::kDone ||
                  step.end == commission::StepEnd::kAtWindow);
    }
  }
}
