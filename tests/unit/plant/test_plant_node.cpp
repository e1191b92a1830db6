// SPDX-License-Identifier: Apache-2.0
// The machine and the operator on a bus.

#include "app/plant/excavator_node.hpp"

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/plant/fixture/node_rig.hpp"

using namespace graben::plant;
namespace bus = dbc::excavator;
using namespace graben::plant::test;
using dbc::RawState;

TEST(messages_come_at_their_rates, Rig rig) {
  rig.cycles(200);
  check_seen<bus::BoomStroke, bus::ArmStroke, bus::BucketStroke, bus::BoomPressure,
             bus::ArmPressure, bus::BucketPressure>(rig, 200);
  check_seen<bus::PumpState, bus::EEC1, bus::OperatorCommand, bus::ValveState>(rig, 100);
  check_seen<bus::MachineIdentity>(rig, 2);
  assert_int_equal(rig.seen.size(), 11);
}

TEST(frames_are_protected, Rig rig) {
  rig.cycles(100);
  check_protection<bus::BoomStroke, bus::ArmStroke, bus::BucketStroke, bus::BoomPressure,
                   bus::ArmPressure, bus::BucketPressure, bus::PumpState, bus::ValveState,
                   bus::OperatorCommand>(rig);
}

/// Off by their zeros always, and by what a seed draws beside them.
TEST(sensors_are_off_by_their_zeros, SensorErrors errors) {
  errors.stroke_bias_m = 2e-3;
  errors.pressure_range_pa = 40e6;
  errors.pressure_bias_ratio = 0.01;
  const SensorModel plain(errors, 3);
  errors.stroke_zero_m[kArm] = -0.01;
  errors.cap_zero_pa[kBoom] = 1e6;
  errors.rod_zero_pa[kSwing] = -1e6;
  SensorModel exact(errors, std::nullopt);
  assert_near(exact.stroke_m(kArm, 0.5), 0.49, 1e-12);
  assert_near(exact.stroke_m(kBoom, 0.5), 0.5, 0.0);
  assert_near(exact.cap_pressure_pa(kBoom, 5e6), 6e6, 1e-6);
  assert_near(exact.rod_pressure_pa(kBoom, 5e6), 5e6, 0.0);
  assert_near(exact.rod_pressure_pa(kSwing, 5e6), 4e6, 1e-6);
  assert_near(exact.rod_pressure_pa(kSwing, 0.5e6), 0.0, 0.0);
  const SensorModel biased(errors, 3);
  assert_near(biased.stroke_m(kArm, 0.5), plain.stroke_m(kArm, 0.5) - 0.01, 1e-12);
}

TEST(values_are_the_plants, Rig rig) {
  rig.cycles(3);
  const ExcavatorPlant& plant = rig.machine.plant();
  // Encoder 0.1 mm, bus 0.05 mm and 1 kPa.
  assert_near(last<bus::BoomStroke>(rig).boom_stroke_m.value, plant.strokes_m()[0], 0.06e-3);
  assert_near(last<bus::ArmStroke>(rig).arm_stroke_m.value, plant.strokes_m()[1], 0.06e-3);
  assert_near(last<bus::BucketStroke>(rig).bucket_stroke_m.value, plant.strokes_m()[2], 0.06e-3);
  const auto cap = plant.cap_pressures_pa();
  const auto rod = plant.rod_pressures_pa();
  assert_near(last<bus::BoomPressure>(rig).boom_cap_pressure_pa.value, cap[0], 501.0);
  assert_near(last<bus::BoomPressure>(rig).boom_rod_pressure_pa.value, rod[0], 501.0);
  assert_near(last<bus::ArmPressure>(rig).arm_cap_pressure_pa.value, cap[1], 501.0);
  assert_near(last<bus::ArmPressure>(rig).arm_rod_pressure_pa.value, rod[1], 501.0);
  assert_near(last<bus::BucketPressure>(rig).bucket_cap_pressure_pa.value, cap[2], 501.0);
  assert_near(last<bus::BucketPressure>(rig).bucket_rod_pressure_pa.value, rod[2], 501.0);
  assert_near(last<bus::PumpState>(rig).pump1_swash_ratio.value, 0.643, 1e-5);
  assert_near(last<bus::PumpState>(rig).pump2_swash_ratio.value, 0.643, 1e-5);
  assert_near(last<bus::EEC1>(rig).engine_speed_radps.value, 188.5, 0.01);
  assert_int_equal(last<bus::MachineIdentity>(rig).profile_hash.value, kHash);
  assert_int_equal(last<bus::MachineIdentity>(rig).dbc_version.value, bus::kDbcVersion);
}

TEST(sensors_show_what_they_can, SensorErrors errors) {
  errors.stroke_resolution_m = 1e-4;
  errors.pressure_range_pa = 25e6;
  errors.stroke_bias_m = 2e-3;
  errors.pressure_bias_ratio = 0.03;
  errors.pressure_noise_ratio = 0.02;
  SensorModel sensors(errors, std::nullopt);
  assert_near(sensors.stroke_m(kArm, 0.123456), 0.1235, 1e-12);
  assert_near(sensors.cap_pressure_pa(kArm, -2e4), 0.0, 0.0);
  assert_near(sensors.cap_pressure_pa(kArm, 7e6), 7e6, 0.0);
  assert_near(sensors.rod_pressure_pa(kArm, 30e6), 25e6, 0.0);
}

TEST(commands_move_the_spool, Rig rig) {
  rig.command_for(2, true, 0.5);
  assert_false(rig.machine.spools_enabled());  // the sequence is not confirmed yet
  rig.command_for(30, true, 0.5);
  assert_true(rig.machine.spools_enabled());
  assert_near(rig.boom_spool(), 0.5, 1e-3);
  assert_true(rig.machine.plant().strokes_m()[kBoom] > 0.7);
  assert_int_equal(rig.machine.counters().accepted, 30);
}

TEST(plant_runs_10_ms_a_cycle, Rig rig) {
  rig.command_for(30, true, 0.5);  // the third is the first to be accepted
  ExcavatorPlant alone(machine_22t(), {0.7, 0.7, 0.6});
  alone.advance(2 * kCycleUs);
  alone.set_duty({0.5, 0.0, 0.0}, true);
  alone.advance(28 * kCycleUs);
  assert_near(rig.boom_spool(), alone.spool_travels_ratio()[kBoom], 0.0);
  assert_near(rig.machine.plant().strokes_m()[kBoom], alone.strokes_m()[kBoom], 0.0);
}

TEST(enable_off_is_neutral_at_once, Rig rig) {
  rig.command_for(30, true, 0.5);
  rig.command_for(1, false, 0.5);
  assert_false(rig.machine.spools_enabled());
  assert_true(rig.boom_spool() < 0.48);
  rig.command_for(30, false, 0.5);
  assert_near(rig.boom_spool(), 0.0, 1e-4);
}

TEST(silence_is_neutral_after_100_ms, Rig rig) {
  rig.command_for(30, true, 0.5);  // the last one came 10 ms ago
  rig.cycles(9);
  assert_true(rig.machine.spools_enabled());
  assert_near(rig.boom_spool(), 0.5, 1e-3);
  rig.cycle();
  assert_false(rig.machine.spools_enabled());
  assert_true(rig.boom_spool() < 0.48);
  assert_int_equal(rig.machine.counters().timeouts, 1);
  rig.cycles(50);
  assert_near(rig.boom_spool(), 0.0, 1e-4);
  assert_int_equal(rig.machine.counters().timeouts, 1);
}

/// After a silence commands that are right and in order, as a queue lets them go: not before Off.
TEST(a_silence_ends_with_enable_off, Rig rig) {
  rig.command_for(30, true, 0.5);
  rig.cycles(10);
  rig.command_for(20, true, 0.5);
  assert_false(rig.machine.spools_enabled());
  assert_near(rig.boom_spool(), 0.0, 1e-3);
  rig.command_for(1, false, 0.0);
  rig.command_for(1, true, 0.5);
  assert_true(rig.machine.spools_enabled());
}

/// An enable that says 'error' is no Off.
TEST(an_unusable_enable_does_not_end_a_silence, Rig rig) {
  rig.command_for(30, true, 0.5);
  rig.cycles(10);
  rig.command_for(3, true, 0.5);
  bus::SpoolCommand message;
  message.enable.state = RawState::kError;
  rig.send_and_cycle(rig.frame_of(message));
  rig.command_for(3, true, 0.5);
  assert_false(rig.machine.spools_enabled());
}

TEST(wrong_frames_are_no_sign_of_life) {
  using Spoil = void (*)(CanFrame&);
  const Spoil spoils[] = {
      [](CanFrame& f) { f.data[3] = static_cast<std::uint8_t>(f.data[3] ^ 0x10U); },
      [](CanFrame& f) { e2e_protect(f.data, bus::SpoolCommand::kDataId, 15); },
      [](CanFrame& f) { e2e_protect(f.data, bus::SpoolCommand::kDataId, 3); },
      [](CanFrame& f) { e2e_protect(f.data, bus::BoomStroke::kDataId, f.data[1] & 0x0FU); },
      [](CanFrame& f) { f.length = 7; },
      [](CanFrame& f) { f.extended = false; },
      [](CanFrame& f) { f.remote = true; },
      [](CanFrame& f) { f.error = true; },
      [](CanFrame& f) { f.fd = true; },
  };
  for (const Spoil spoil : spoils) {
    Rig rig;
    rig.command_for(30, true, 0.5);
    for (int i = 0; i < 10; ++i) {
      CanFrame frame = rig.command(true, 0.5);
      spoil(frame);
      rig.send_and_cycle(frame);
    }
    assert_false(rig.machine.spools_enabled());
    assert_int_equal(rig.machine.counters().accepted, 28);
    assert_int_equal(rig.machine.counters().wrong_format + rig.machine.counters().rejected, 12);
  }
}

TEST(unusable_values_are_neutral) {
  for (const RawState state : {RawState::kError, RawState::kNotAvailable}) {
    for (int which = 0; which < 4; ++which) {
      Rig rig;
      rig.command_for(30, true, 0.5);
      bus::SpoolCommand message;
      message.enable.value = bus::SpoolCommand::Enable::kOn;
      message.boom_duty_ratio.value = 0.5;
      (which == 0   ? message.boom_duty_ratio.state
       : which == 1 ? message.arm_duty_ratio.state
       : which == 2 ? message.bucket_duty_ratio.state
                    : message.enable.state) = state;
      rig.send_and_cycle(rig.frame_of(message));
      assert_false(rig.machine.spools_enabled());
    }
  }
}

TEST(command_reaches_every_spool_and_each_is_told, Rig rig) {
  for (int i = 0; i < 60; ++i) {
    bus::SpoolCommand message;
    message.enable.value = bus::SpoolCommand::Enable::kOn;
    message.boom_duty_ratio.value = 0.1;
    message.arm_duty_ratio.value = -0.15;
    message.bucket_duty_ratio.value = 0.18;
    rig.send_and_cycle(rig.frame_of(message));
  }
  const auto travel = rig.machine.plant().spool_travels_ratio();
  assert_near(travel[kBoom], 0.1, 1e-6);
  assert_near(travel[kArm], -0.15, 1e-6);
  assert_near(travel[kBucket], 0.18, 1e-6);
  const auto valve = last<bus::ValveState>(rig);
  assert_near(valve.boom_spool_ratio.value, 0.1, 1e-4);
  assert_near(valve.arm_spool_ratio.value, -0.15, 1e-4);
  assert_near(valve.bucket_spool_ratio.value, 0.18, 1e-4);
}

TEST(flood_does_not_starve_the_command, Rig rig) {
  for (int i = 0; i < 5; ++i) {
    for (int k = 0; k < 200; ++k) {
      CanFrame other;
      other.id = 0x18FF9999;
      assert_true(rig.our_port.send(other));
    }
    rig.send_and_cycle(rig.command(true, 0.5));
  }
  assert_true(rig.machine.spools_enabled());
}

TEST(silenced_messages_stop, Rig rig) {
  rig.machine.faults().set_silent(bus::ArmStroke::kId, true);
  rig.driver.set_silent(true);
  rig.cycles(10);
  check_seen<bus::ArmStroke, bus::OperatorCommand>(rig, 0);
  assert_int_equal(rig.seen[bus::BoomStroke::kId].size(), 10);
  rig.machine.faults().set_silent(bus::ArmStroke::kId, false);
  rig.cycles(20);
  assert_int_equal(rig.seen[bus::ArmStroke::kId].size(), 20);
  check_protection<bus::ArmStroke>(rig);
}

TEST(strokes_can_fail, Rig rig) {
  rig.machine.faults().set_stroke_state(kArm, RawState::kError);
  rig.machine.faults().set_stroke_state(kBucket, RawState::kNotAvailable);
  rig.cycle();
  assert_true(last<bus::BoomStroke>(rig).boom_stroke_m.state == RawState::kValid);
  assert_true(last<bus::ArmStroke>(rig).arm_stroke_m.state == RawState::kError);
  assert_true(last<bus::BucketStroke>(rig).bucket_stroke_m.state == RawState::kNotAvailable);
}

TEST(operator_follows_the_schedule, Rig rig) {
  rig.driver.set_schedule({{100'000, {true, OperatorMode::kAutomatic, Task::kDig, 0.5}},
                           {200'000, {false, OperatorMode::kManual, Task::kNone, 1.0}}});
  rig.cycles(9);
  auto message = last<bus::OperatorCommand>(rig);
  assert_true(message.enable.value == bus::OperatorCommand::Enable::kOff);
  assert_true(message.task.value == bus::OperatorCommand::Task::kNone);
  rig.cycles(2);
  message = last<bus::OperatorCommand>(rig);
  assert_true(message.enable.value == bus::OperatorCommand::Enable::kOn);
  assert_true(message.operator_mode.value == bus::OperatorCommand::OperatorMode::kAutomatic);
  assert_true(message.task.value == bus::OperatorCommand::Task::kDig);
  assert_near(message.speed_override_ratio.value, 0.5, 1e-9);
  rig.cycles(20);
  message = last<bus::OperatorCommand>(rig);
  assert_true(message.enable.value == bus::OperatorCommand::Enable::kOff);
  assert_near(message.speed_override_ratio.value, 1.0, 1e-9);
}

/// A station without levers sends none; windows come by turns, of the drives that have one.
TEST(hands_are_sent_where_they_are, Rig rig) {
  rig.cycles(20);
  check_seen<bus::OperatorAxes, bus::CommissionDuty, bus::CommissionWindow>(rig, 0);
  OperatorHands hands;
  hands.lever_ratio = {0.2, -0.4, 0.6, -0.8};
  hands.tried_ratio = {0.1, 0.0, -0.3};
  hands.window[0] = StrokeWindow{0.1, 0.2, 0.3};
  hands.window[2] = StrokeWindow{0.4, 0.5, 0.6};
  rig.driver.set_hands(hands);
  rig.cycles(20);
  check_seen<bus::OperatorAxes, bus::CommissionDuty>(rig, 10);
  const auto axes = last<bus::OperatorAxes>(rig);
  assert_near(axes.boom_or_up_ratio.value, 0.2, 1e-9);
  assert_near(axes.arm_or_forward_ratio.value, -0.4, 1e-9);
  assert_near(axes.bucket_or_attitude_ratio.value, 0.6, 1e-9);
  assert_near(axes.swing_ratio.value, -0.8, 1e-9);
  const auto duty = last<bus::CommissionDuty>(rig);
  assert_near(duty.boom_duty_ratio.value, 0.1, 1e-9);
  assert_near(duty.arm_duty_ratio.value, 0.0, 1e-9);
  assert_near(duty.bucket_duty_ratio.value, -0.3, 1e-9);
  rig.cycles(20);
  const auto& windows = rig.seen[bus::CommissionWindow::kId];
  assert_int_equal(windows.size(), 4);
  for (std::size_t n = 0; n < windows.size(); ++n) {
    const auto window = bus::CommissionWindow::decode(windows[n].data);
    const bool boom = n % 2 == 0;
    assert_true(window.drive.value == (boom ? bus::CommissionWindow::Drive::kBoom
                                            : bus::CommissionWindow::Drive::kBucket));
    assert_near(window.least_stroke_m.value, boom ? 0.1 : 0.4, 1e-9);
    assert_near(window.most_stroke_m.value, boom ? 0.2 : 0.5, 1e-9);
    assert_near(window.most_speed_mps.value, boom ? 0.3 : 0.6, 1e-9);
  }
  check_protection<bus::CommissionWindow>(rig);
}
