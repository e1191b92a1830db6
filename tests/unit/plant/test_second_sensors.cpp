// SPDX-License-Identifier: Apache-2.0
// Second sensors of the simulated excavator: what they show, and how far they are off.

#include "app/plant/second_sensors.hpp"

#include "app/machines/second_section.hpp"
#include "app/plant/excavator_node.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/plant/fixture/swing_rig.hpp"

using namespace graben::plant;
using namespace graben::plant::test;
using dbc::RawState;

ExcavatorPlantProfile with_seconds(ExcavatorPlantProfile profile) {
  machines::fit_usual_seconds(profile.machine);
  return profile;
}

/// The plant stands where it starts.
struct Sensors {
  ExcavatorPlantProfile profile;
  ExcavatorPlant plant;
  ExcavatorFaults faults;
  SecondSensorModel model;

  explicit Sensors(const ExcavatorPlantProfile& of)
      : profile(with_seconds(of)), plant(profile, {0.5, 0.6, 0.7}, 0.25), model(profile) {}

  double shown(std::size_t drive) {
    model.look(plant, faults);
    assert_int_equal(model.shown(drive).state, RawState::kValid);
    return model.shown(drive).value;
  }
};

TEST(without_errors_they_show_the_truth) {
  Sensors sensors(machine_12t());
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    assert_near(sensors.shown(i), sensors.plant.strokes_m()[i], 1e-12);
  }
  assert_near(sensors.shown(kSwing), sensors.plant.swing_rad(), 1e-12);
}

TEST(each_is_off_by_its_own) {
  ExcavatorPlantProfile profile = machine_12t();
  profile.sensor_errors = true;
  double worst_m = 0.0;
  for (profile.seed = 1; profile.seed < 200; ++profile.seed) {
    Sensors sensors(profile);
    for (std::size_t i = 0; i < kAxisCount; ++i) {
      const double true_m = sensors.plant.strokes_m()[i];
      const double most_m = profile.sensors.second_bias_m + profile.sensors.second_scale * true_m;
      const double off_m = std::abs(sensors.shown(i) - true_m);
      assert_true(off_m <= most_m + 1e-12 && off_m > 0.0);
      worst_m = std::max(worst_m, off_m);
    }
    assert_true(sensors.shown(kSwing) != sensors.plant.swing_rad());
  }
  assert_true(worst_m > 0.8 * profile.sensors.second_bias_m);
}

TEST(they_fail_by_themselves) {
  Sensors sensors(machine_12t());
  const double arm_m = sensors.shown(kArm);
  sensors.faults.axis[kArm].stroke.jump_m = 0.1;
  assert_near(sensors.shown(kArm), arm_m, 0.0);
  sensors.faults.axis[kArm].second.jump_m = 0.1;
  sensors.faults.swing.second.jump_rad = 0.1;
  assert_near(sensors.shown(kArm), arm_m + 0.1, 1e-12);
  assert_near(sensors.shown(kBoom), 0.5, 1e-12);
  assert_near(sensors.shown(kSwing), 0.35, 1e-12);
}

/// A reading of a cylinder that moves is as old as told.
TEST(they_are_late) {
  ExcavatorPlantProfile profile = machine_12t();
  profile.sensors.second_age_s = {0.015, 0.015};
  Sensors sensors(profile);
  ExcavatorPlant::DriveArray duty{};
  duty[kArm] = 0.6;
  sensors.plant.set_duty(duty, true);
  std::array<double, 3> last_m{};
  for (int n = 0; n < 60; ++n) {
    sensors.plant.advance(10 * kMillisecondUs);
    last_m = {sensors.plant.strokes_m()[kArm], last_m[0], last_m[1]};
    sensors.model.look(sensors.plant, sensors.faults);
  }
  assert_true(last_m[0] > last_m[2] + 1e-3);
  assert_near(sensors.model.shown(kArm).value, 0.5 * (last_m[1] + last_m[2]), 1e-12);
}

TEST(frames_come_where_the_machine_has_them, SwingRig without) {
  without.cycles(200);
  assert_int_equal(without.seen.count(bus::SecondStrokes::kId), 0);
  assert_int_equal(without.seen.count(bus::SecondSwing::kId), 0);
  SwingRig rig(with_seconds(machine_12t()));
  rig.cycles(200);
  assert_int_equal(rig.seen.size(), without.seen.size() + 2);
  assert_int_equal(rig.seen[bus::SecondStrokes::kId].size(), 100);
  assert_int_equal(rig.seen[bus::SecondSwing::kId].size(), 40);
  check_protection<bus::SecondStrokes, bus::SecondSwing>(rig);
  assert_near(last<bus::SecondStrokes>(rig).arm_stroke_m.value,
              rig.machine.plant().strokes_m()[kArm], 1e-3);
  assert_near(last<bus::SecondSwing>(rig).swing_angle_rad.value, rig.machine.plant().swing_rad(),
              1e-3);
}
