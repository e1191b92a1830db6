// SPDX-License-Identifier: Apache-2.0
// One path of the dozer's transmission: (9), losses, oil, relief, servos, brake.

#include "app/plant/dozer_hst_path.hpp"

#include <algorithm>

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/plant/fixture/machines.hpp"

using namespace graben::plant;

constexpr double kEngine = 157.08;
constexpr double kTwoPi = 6.283185307179586;

void run(HstPath& path, double duration_s, double traction_n, bool brake = false,
         double engine_radps = kEngine, double step_s = 5e-4) {
  for (int i = 0; i < static_cast<int>(std::lround(duration_s / step_s)); ++i) {
    path.step(engine_radps, traction_n, brake);
  }
}

HstPath driven(double pump, double motor, double traction_n, double engine_radps = kEngine) {
  HstPath path(dozer_9t());
  path.pump().set_wanted(pump);
  path.motor().set_wanted(motor);
  run(path, 3.0, traction_n, false, engine_radps);
  return path;
}

/// (9) times the sprocket's radius.
double nominal_mps(double pump, double motor, double engine_radps = kEngine) {
  return engine_radps * pump / motor * (90.0 / 100.0) / 70.9 * 0.95 * 0.95 * 0.35;
}

double working_pa(const HstPath& path) { return path.pressures_pa()[0] - path.pressures_pa()[1]; }

// The largest is 1.8 m/s, with the motor's smallest displacement; at the working pressure (9)
// holds.
TEST(at_work_it_goes_as_fast_as_9_says) {
  assert_near(nominal_mps(1.0, 0.35), 1.80, 0.005);
  for (const double motor : {1.0, 0.7, 0.35}) {
    // Motor torque of 15 MPa less a tenth, on the sprocket.
    const double traction = 0.9 * 15e6 * motor * 100e-6 * 70.9 / kTwoPi / 0.35;
    const HstPath path = driven(1.0, motor, traction);
    assert_near(working_pa(path), 15e6, 0.02e6);
    assert_near(path.track_speed_mps() / nominal_mps(1.0, motor), 1.0, 0.002);
  }
  const double traction = 0.9 * 15e6 * 100e-6 * 70.9 / kTwoPi / 0.35;
  const HstPath back = driven(-1.0, 1.0, -traction);
  assert_near(back.track_speed_mps() / nominal_mps(1.0, 1.0), -1.0, 0.002);
}

TEST(with_less_load_it_leaks_less) {
  double last = 1.0;
  for (const double load : {15e6, 8e6, 3e6, 0.0}) {
    const HstPath path = driven(1.0, 0.4, 0.9 * load * 0.4 * 100e-6 * 70.9 / kTwoPi / 0.35);
    const double ratio = path.track_speed_mps() / nominal_mps(1.0, 0.4);
    assert_true(ratio > last - 0.002);
    last = ratio;
  }
  // What is left is the share that goes with speed alone.
  assert_near(last, (1.0 - 0.6 * 0.05) / (1.0 + 0.6 * (1.0 / 0.95 - 1.0)) / (0.95 * 0.95), 0.002);
}

TEST(speed_follows_engine_and_displacements) {
  const double whole = driven(1.0, 1.0, 0.0).track_speed_mps();
  assert_near(driven(0.5, 1.0, 0.0).track_speed_mps() / whole, 0.5, 0.003);
  assert_near(driven(1.0, 0.5, 0.0).track_speed_mps() / whole, 2.0, 0.01);
  assert_near(driven(1.0, 1.0, 0.0, 0.6 * kEngine).track_speed_mps() / whole, 0.6, 0.003);
  assert_near(driven(0.0, 1.0, 0.0).track_speed_mps(), 0.0, 1e-9);
}

// Steady: what the pump gives, the motor takes and both leak; nothing through relief or charge at
// the high line, and the low one is held at the charge pressure.
TEST(oil_is_accounted_for) {
  HstPath path(dozer_9t());
  path.pump().set_wanted(0.8);
  path.motor().set_wanted(0.6);
  double a = path.line(0).content_m3();
  double b = path.line(1).content_m3();
  for (int i = 0; i < 4000; ++i) {
    path.step(kEngine, i < 2000 ? 20e3 : -5e3, false);
    a += 5e-4 * (path.flows().pump_in[0] + path.flows().motor_in[0]);
    b += 5e-4 * (path.flows().pump_in[1] + path.flows().motor_in[1]);
    assert_near(path.line(0).content_m3(), a, 1e-12);
    assert_near(path.line(1).content_m3(), b, 1e-12);
  }
  const HstPath steady = driven(1.0, 1.0, 30e3);
  assert_near(steady.flows().pump_in[0], -steady.flows().motor_in[0], 1e-9);
  const double pressure = working_pa(steady);
  const double geometric = 90e-6 * kEngine / kTwoPi * (1.0 - 0.6 * 0.05);
  const double leak = 0.4 * 0.05 * 90e-6 * kEngine / kTwoPi / 15e6;
  assert_near(steady.flows().pump_in[0], geometric - leak * pressure, 1e-7);
  assert_near(steady.pressures_pa()[1], 2.5e6, 0.01e6);
  // Power: what the sprocket gives is what the oil gives it less a tenth.
  assert_near(30e3 * 0.35, 0.9 * steady.motor_torque_nm(), 1.0);
  assert_near(steady.motor_torque_nm(), 100e-6 * 70.9 / kTwoPi * pressure, 10.0);
}

TEST(a_stalled_track_opens_the_relief) {
  HstPath path(dozer_9t());
  path.pump().set_wanted(1.0);
  for (int i = 0; i < 4000; ++i) {
    path.step(kEngine, 0.0, true);
    // 42 MPa over the charge pressure, and the valve's override with the whole flow.
    assert_true(path.pressures_pa()[0] < 42e6 + 2.5e6 + 5e8 * 2.3e-3);
    assert_true(path.pressures_pa()[1] > 2.4e6);
  }
  assert_true(path.pressures_pa()[0] > 44e6);
  assert_near(path.track_speed_mps(), 0.0, 0.0);
  path.pump().set_wanted(-1.0);
  run(path, 2.0, 0.0, true);
  assert_true(path.pressures_pa()[1] > 44e6 && path.pressures_pa()[1] < 45.7e6);
}

// What the low line lacks comes from the charge pump: it never boils, however hard the track is
// dragged.
TEST(charge_feeds_the_low_line) {
  HstPath path(dozer_9t());
  double lowest = 1e9;
  path.pump().set_wanted(1.0);
  run(path, 2.0, 10e3);
  path.pump().set_wanted(0.0);
  for (int i = 0; i < 4000; ++i) {
    path.step(kEngine, -60e3, false);
    // While the wave of the blow runs to and fro a little less.
    assert_true(path.pressures_pa()[0] > (i < 20 ? 1.5e6 : 2.2e6));
    lowest = std::min(lowest, path.pressures_pa()[0]);
  }
  assert_true(path.pressures_pa()[1] > 15e6);
  // A line is oil down to 0 absolute, not to the charge pressure.
  assert_true(lowest < 2.2e6);
}

// A circuit that leaks nothing does not pump itself up on what the check lets in with every blow:
// the flushing valve lets it out of the lower line again.
TEST(the_low_line_comes_back_to_the_charge_pressure) {
  DozerPlantProfile tight = dozer_9t();
  tight.machine.hst.pump_efficiency = 1.0;
  tight.machine.hst.motor_efficiency = 1.0;
  HstPath path(tight);
  for (int blow = 0; blow < 40; ++blow) {
    path.pump().set_wanted(blow % 2 == 0 ? 0.8 : -0.8);
    run(path, 1.0, blow % 2 == 0 ? 30e3 : -5e3);
  }
  path.pump().set_wanted(0.3);
  run(path, 3.0, 10e3);
  assert_near(path.pressures_pa()[1], 2.5e6, 0.05e6);
  assert_near(path.pressures_pa()[0] - 2.5e6, working_pa(path), 0.05e6);
}

TEST(the_brake_stops_and_holds) {
  HstPath path = driven(0.0, 1.0, 0.0);
  run(path, 1.0, 100e3, true);
  assert_near(path.track_speed_mps(), 0.0, 0.0);
  run(path, 1.0, -100e3, true);
  assert_near(path.track_speed_mps(), 0.0, 0.0);
  HstPath moving = driven(0.5, 1.0, 5e3);
  moving.pump().set_wanted(0.0);
  run(moving, 0.2, 5e3, true);
  assert_near(moving.track_speed_mps(), 0.0, 0.0);
  // Beyond what it holds it slips.
  run(path, 0.5, 400e3, true);
  assert_true(path.track_speed_mps() < 0.0);
}

TEST(a_displacement_lags_and_has_a_rate) {
  HstPath path(dozer_9t());
  path.pump().set_wanted(0.1);
  run(path, 0.08, 0.0);
  assert_near(path.pump().ratio(), 0.1 * (1.0 - std::exp(-1.0)), 1e-4);
  run(path, 2.0, 0.0);
  path.pump().set_wanted(1.0);
  run(path, 0.1, 0.0);
  assert_near(path.pump().ratio(), 0.1 + 0.1 * 5.0, 1e-6);
  path.motor().set_wanted(0.35);
  run(path, 0.1, 0.0);
  assert_near(path.motor().ratio(), 1.0 - 0.1 * 2.5, 1e-6);
  path.motor().set_wanted(-4.0);
  path.pump().set_wanted(-7.0);
  run(path, 3.0, 0.0);
  assert_near(path.motor().ratio(), 0.35, 1e-9);
  assert_near(path.pump().ratio(), -1.0, 1e-9);
  path.pump().set_wanted(std::nan(""));
  path.motor().set_wanted(-INFINITY);
  run(path, 3.0, 0.0);
  assert_near(path.pump().ratio(), 0.0, 1e-9);
  assert_near(path.motor().ratio(), 1.0, 1e-9);
}

TEST(a_servo_can_be_broken) {
  HstPath path(dozer_9t());
  path.pump().set_wanted(0.4);
  path.pump().set_fault({0.9, 0.0, false});
  run(path, 2.0, 0.0);
  assert_near(path.pump().ratio(), 0.9, 1e-6);
  path.pump().set_fault({std::nullopt, -0.3, false});
  run(path, 2.0, 0.0);
  assert_near(path.pump().ratio(), 0.1, 1e-6);
  path.pump().set_fault({std::nullopt, 0.0, true});
  run(path, 2.0, 0.0);
  assert_near(path.pump().ratio(), -0.4, 1e-6);
  assert_true(path.track_speed_mps() < -0.2);
  path.pump().set_fault({});
  path.motor().set_fault({0.5, 0.0, false});
  run(path, 2.0, 0.0);
  assert_near(path.pump().ratio(), 0.4, 1e-6);
  assert_near(path.motor().ratio(), 0.5, 1e-6);
  path.motor().set_fault({std::nullopt, -0.2, false});
  run(path, 2.0, 0.0);
  assert_near(path.motor().ratio(), 0.8, 1e-6);
}
