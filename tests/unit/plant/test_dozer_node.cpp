// SPDX-License-Identifier: Apache-2.0
// The dozer on a bus: what it sends, and what its commands do.

#include "app/plant/dozer_node.hpp"

#include "tests/unit/plant/fixture/dozer_rig.hpp"

using namespace graben::plant;
using namespace graben::plant::test;
using dbc::RawState;

TEST(messages_come_at_their_rates, DozerRig rig) {
  rig.cycle();
  assert_int_equal(rig.seen.size(), 10);
  check_seen<dozer_bus::ValveState>(rig, 0);
  rig.cycles(199);
  check_seen<dozer_bus::BladeStroke, dozer_bus::BodyPosition, dozer_bus::BodyPitch,
             dozer_bus::BodyVelocity, dozer_bus::LeftTransmission, dozer_bus::RightTransmission,
             dozer_bus::TrackSpeed>(rig, 200);
  check_seen<dozer_bus::EEC1, dozer_bus::ValveState, dozer_bus::OperatorCommand>(rig, 100);
  check_seen<dozer_bus::MachineIdentity>(rig, 2);
  assert_int_equal(rig.seen.size(), 11);
}

TEST(frames_are_protected, DozerRig rig) {
  rig.cycles(100);
  check_protection<dozer_bus::BladeStroke, dozer_bus::BodyPosition, dozer_bus::BodyPitch,
                   dozer_bus::BodyVelocity, dozer_bus::LeftTransmission,
                   dozer_bus::RightTransmission, dozer_bus::TrackSpeed, dozer_bus::ValveState,
                   dozer_bus::OperatorCommand>(rig);
}

/// Drives with the left track slower, blade going up, commands of every kind each cycle.
void drive_for(DozerRig& rig, int count) {
  for (int i = 0; i < count; ++i) {
    assert_true(rig.our_port.send(rig.spool(true, -0.4)));
    assert_true(rig.our_port.send(rig.motors(0.9, 0.8)));
    rig.send_and_cycle(rig.pumps(false, 0.5, 0.7));
  }
}

TEST(values_are_the_plants) {
  DozerPlantProfile profile = dozer_9t();
  DozerRig rig(profile);
  drive_for(rig, 100);
  const DozerPlant& plant = rig.machine.plant();
  assert_true(plant.velocity_mps() > 0.3);
  assert_near(last<dozer_bus::BladeStroke>(rig).blade_stroke_m.value, plant.blade_stroke_m(),
              0.06e-3);
  const auto position = last<dozer_bus::BodyPosition>(rig);
  assert_near(position.position_m.value, plant.position_m(), 0.06e-3);
  assert_near(position.height_m.value, plant.height_m(), 0.3e-3);
  const auto pitch = last<dozer_bus::BodyPitch>(rig);
  assert_near(pitch.pitch_rad.value, plant.pitch_rad(), 0.03e-3);
  assert_near(pitch.pitch_rate_radps.value, plant.pitch_rate_radps(), 0.06e-3);
  const auto velocity = last<dozer_bus::BodyVelocity>(rig);
  assert_near(velocity.forward_mps.value, plant.velocity_mps(), 0.06e-3);
  assert_near(velocity.climb_mps.value, plant.climb_mps(), 0.06e-3);
  const auto left = last<dozer_bus::LeftTransmission>(rig);
  const auto right = last<dozer_bus::RightTransmission>(rig);
  assert_near(left.pump_ratio.value, plant.pump_ratios()[kLeft], 5e-5);
  assert_near(right.pump_ratio.value, plant.pump_ratios()[kRight], 5e-5);
  assert_near(left.motor_ratio.value, plant.motor_ratios()[kLeft], 5e-5);
  assert_near(right.motor_ratio.value, plant.motor_ratios()[kRight], 5e-5);
  assert_true(left.motor_ratio.value > right.motor_ratio.value + 0.05);
  const auto a = plant.path(kLeft).pressures_pa();
  const auto b = plant.path(kRight).pressures_pa();
  assert_near(left.line_pressure_pa.value, std::max(a[0], a[1]), 501.0);
  assert_near(right.line_pressure_pa.value, std::max(b[0], b[1]), 501.0);
  const auto tracks = last<dozer_bus::TrackSpeed>(rig);
  assert_near(tracks.left_track_mps.value, plant.track_speeds_mps()[kLeft], 0.06e-3);
  assert_near(tracks.right_track_mps.value, plant.track_speeds_mps()[kRight], 0.06e-3);
  assert_true(tracks.right_track_mps.value > tracks.left_track_mps.value + 0.02);
  assert_near(last<dozer_bus::EEC1>(rig).engine_speed_radps.value, 157.08, 0.01);
  const auto valve = last<dozer_bus::ValveState>(rig);
  assert_int_equal(valve.enabled.value, dozer_bus::ValveState::Enabled::kOn);
  assert_near(valve.blade_spool_ratio.value, -0.4, 1e-4);
  assert_int_equal(last<dozer_bus::MachineIdentity>(rig).profile_hash.value, kHash);
  assert_int_equal(last<dozer_bus::MachineIdentity>(rig).dbc_version.value, dozer_bus::kDbcVersion);
}

TEST(plant_runs_10_ms_a_cycle, DozerRig rig) {
  drive_for(rig, 30);  // the third is the first to be accepted
  DozerPlant alone(dozer_9t());
  alone.advance(2 * kCycleUs);
  alone.set_brake(false);
  alone.set_blade_duty(-0.4, true);
  alone.set_displacements({0.5, 0.7}, {0.9, 0.8});
  alone.advance(28 * kCycleUs);
  assert_near(rig.machine.plant().position_m(), alone.position_m(), 0.0);
  assert_near(rig.machine.plant().blade_stroke_m(), alone.blade_stroke_m(), 0.0);
}

TEST(it_waits_braked_and_neutral, DozerRig rig) {
  rig.cycles(20);
  assert_true(rig.braked());
  assert_false(rig.machine.spools_enabled());
  assert_near(rig.left_pump(), 0.0, 0.0);
  assert_near(rig.machine.plant().motor_ratios()[kLeft], 1.0, 0.0);
}

TEST(the_spool_follows_its_command, DozerRig rig) {
  rig.spool_for(2, true, 0.5);
  assert_false(rig.machine.spools_enabled());  // the sequence is not confirmed yet
  rig.spool_for(30, true, 0.5);
  assert_near(rig.blade_spool(), 0.5, 1e-3);
  assert_int_equal(rig.machine.counters().accepted, 30);
  rig.spool_for(1, false, 0.5);
  assert_false(rig.machine.spools_enabled());
  rig.spool_for(30, false, 0.5);
  assert_near(rig.blade_spool(), 0.0, 1e-4);
}

TEST(a_silence_of_the_spool_is_neutral_and_wants_off, DozerRig rig) {
  rig.spool_for(30, true, 0.5);
  rig.cycles(9);
  assert_true(rig.machine.spools_enabled());
  rig.cycle();
  assert_false(rig.machine.spools_enabled());
  assert_int_equal(rig.machine.counters().timeouts, 1);
  rig.spool_for(20, true, 0.5);
  assert_false(rig.machine.spools_enabled());
  dozer_bus::SpoolCommand unusable;
  unusable.enable.state = RawState::kError;
  rig.send_and_cycle(rig.frame_of(unusable));
  rig.spool_for(2, true, 0.5);
  assert_false(rig.machine.spools_enabled());
  rig.spool_for(1, false, 0.0);
  rig.spool_for(1, true, 0.5);
  assert_true(rig.machine.spools_enabled());
}

TEST(an_unusable_spool_command_is_neutral) {
  for (const RawState state : {RawState::kError, RawState::kNotAvailable}) {
    for (int which = 0; which < 3; ++which) {
      DozerRig rig;
      rig.spool_for(30, true, 0.5);
      dozer_bus::SpoolCommand message;
      message.enable.value = dozer_bus::SpoolCommand::Enable::kOn;
      message.blade_duty_ratio.value = 0.5;
      (which == 0   ? message.blade_duty_ratio.state
       : which == 1 ? message.pilot_cut.state
                    : message.enable.state) = state;
      rig.send_and_cycle(rig.frame_of(message));
      assert_false(rig.machine.spools_enabled());
    }
  }
}

TEST(the_pilot_cut_centres_a_held_spool, DozerRig rig) {
  rig.machine.faults().spool_held_ratio = 0.4;
  rig.spool_for(30, false, 0.0);
  assert_near(rig.blade_spool(), 0.4, 1e-3);
  dozer_bus::SpoolCommand cut;
  cut.pilot_cut.value = dozer_bus::SpoolCommand::PilotCut::kOn;
  repeat(30, [&] { rig.send_and_cycle(rig.frame_of(cut)); });
  assert_near(rig.blade_spool(), 0.0, 1e-4);
  // Neither an unusable value nor silence ends it.
  for (int i = 0; i < 30; ++i) {
    dozer_bus::SpoolCommand unusable;
    unusable.pilot_cut.state = RawState::kError;
    rig.send_and_cycle(rig.frame_of(unusable));
  }
  assert_near(rig.blade_spool(), 0.0, 1e-4);
  rig.cycles(50);
  assert_near(rig.blade_spool(), 0.0, 1e-4);
  rig.spool_for(33, false, 0.0);
  assert_near(rig.blade_spool(), 0.4, 1e-3);
}

TEST(pumps_motors_and_brake_follow_their_commands, DozerRig rig) {
  rig.pumps_for(50, true, 0.6, -0.3);
  assert_near(rig.left_pump(), 0.6, 0.01);
  assert_near(rig.right_pump(), -0.3, 0.01);
  assert_near(rig.machine.plant().track_speeds_mps()[kLeft], 0.0, 0.0);
  rig.pumps_for(1, false, 0.6, -0.3);
  assert_false(rig.braked());
  rig.motors_for(100, 0.5, 0.7);
  assert_near(rig.machine.plant().motor_ratios()[kLeft], 0.5, 1e-3);
  assert_near(rig.machine.plant().motor_ratios()[kRight], 0.7, 1e-3);
  assert_int_equal(rig.machine.pump_counters().accepted, 49);
  assert_int_equal(rig.machine.motor_counters().accepted, 98);
}

// 100 ms without: pumps to 0 at once, the brake as soon as the tracks stand.
TEST(a_silence_of_the_pumps_stops_the_machine, DozerRig rig) {
  rig.pumps_for(200, false, 1.0, 1.0);
  assert_true(rig.machine.plant().velocity_mps() > 0.6);
  rig.cycles(9);
  assert_near(rig.left_pump(), 1.0, 1e-3);
  rig.cycle();
  assert_true(rig.left_pump() < 0.96);
  assert_false(rig.braked());
  assert_int_equal(rig.machine.pump_counters().timeouts, 1);
  rig.cycles(100);
  assert_true(rig.braked());
  assert_near(rig.machine.plant().velocity_mps(), 0.0, 5e-3);
  // What was stuck in a queue does not move it.
  rig.pumps_for(20, false, 1.0, 1.0);
  assert_near(rig.left_pump(), 0.0, 1e-3);
  assert_true(rig.braked());
  rig.pumps_for(1, false, 1.0, 0.0);
  rig.pumps_for(1, false, 1.0, 1.0);
  assert_true(rig.braked());
  rig.pumps_for(1, false, 0.0, 0.0);
  assert_false(rig.braked());
  rig.pumps_for(60, false, 1.0, 1.0);
  assert_near(rig.left_pump(), 1.0, 1e-2);
}

// A pump that does not obey: the brake closes all the same.
TEST(the_brake_does_not_wait_for_ever, DozerRig rig) {
  rig.machine.faults().path[kLeft].pump.held_ratio = 1.0;
  rig.machine.faults().path[kRight].pump.held_ratio = 1.0;
  rig.pumps_for(200, false, 1.0, 1.0);
  rig.cycles(10 + 199);
  assert_true(rig.machine.plant().track_speeds_mps()[kLeft] > 0.5);
  rig.cycles(20);
  assert_near(rig.machine.plant().track_speeds_mps()[kLeft], 0.0, 0.0);
}

// Nor does it begin to wait anew with each command that cannot be used.
TEST(unusable_commands_do_not_put_the_brake_off, DozerRig rig) {
  rig.machine.faults().path[kLeft].pump.held_ratio = 1.0;
  rig.machine.faults().path[kRight].pump.held_ratio = 1.0;
  rig.pumps_for(200, false, 1.0, 1.0);
  for (int i = 0; i < 220; ++i) {
    dozer_bus::PumpDisplacementCommand message;
    message.left_pump_ratio.state = RawState::kError;
    rig.send_and_cycle(rig.frame_of(message));
  }
  assert_near(rig.machine.plant().track_speeds_mps()[kLeft], 0.0, 0.0);
}

TEST(unusable_displacements_stop_the_machine) {
  for (int which = 0; which < 3; ++which) {
    DozerRig rig;
    rig.pumps_for(100, false, 1.0, 1.0);
    for (int i = 0; i < 150; ++i) {
      dozer_bus::PumpDisplacementCommand message;
      message.brake.value = dozer_bus::PumpDisplacementCommand::Brake::kOff;
      message.left_pump_ratio.value = 1.0;
      message.right_pump_ratio.value = 1.0;
      (which == 0   ? message.left_pump_ratio.state
       : which == 1 ? message.right_pump_ratio.state
                    : message.brake.state) = RawState::kError;
      rig.send_and_cycle(rig.frame_of(message));
    }
    assert_near(rig.left_pump(), 0.0, 1e-3);
    assert_near(rig.right_pump(), 0.0, 1e-3);
    assert_true(rig.braked());
    // No silence: a command that is right counts at once.
    rig.pumps_for(30, false, 1.0, 1.0);
    assert_true(rig.left_pump() > 0.5);
  }
  DozerRig rig;
  rig.motors_for(100, 0.5, 0.5);
  for (int i = 0; i < 100; ++i) {
    dozer_bus::MotorDisplacementCommand message;
    message.left_motor_ratio = {0.5, RawState::kNotAvailable};
    message.right_motor_ratio.value = 0.5;
    rig.send_and_cycle(rig.frame_of(message));
  }
  assert_near(rig.machine.plant().motor_ratios()[kLeft], 1.0, 1e-3);
  assert_near(rig.machine.plant().motor_ratios()[kRight], 0.5, 1e-3);
  rig.cycles(100);
  assert_near(rig.machine.plant().motor_ratios()[kRight], 1.0, 1e-3);
  assert_int_equal(rig.machine.motor_counters().timeouts, 1);
}

TEST(wrong_frames_are_no_sign_of_life) {
  using Spoil = void (*)(CanFrame&);
  const Spoil spoils[] = {
      [](CanFrame& f) { f.data[3] = static_cast<std::uint8_t>(f.data[3] ^ 0x10U); },
      [](CanFrame& f) { e2e_protect(f.data, dozer_bus::SpoolCommand::kDataId, f.data[1] & 0x0FU); },
      [](CanFrame& f) { f.length = 7; },
      [](CanFrame& f) { f.extended = false; },
  };
  for (const Spoil spoil : spoils) {
    DozerRig rig;
    rig.pumps_for(50, false, 1.0, 1.0);
    for (int i = 0; i < 100; ++i) {
      CanFrame frame = rig.pumps(false, 1.0, 1.0);
      spoil(frame);
      rig.send_and_cycle(frame);
    }
    assert_near(rig.left_pump(), 0.0, 1e-3);
    assert_true(rig.braked());
    assert_int_equal(rig.machine.pump_counters().timeouts, 1);
    assert_int_equal(rig.machine.pump_counters().accepted, 48);
  }
}

TEST(the_operator_asks_for_grading, DozerRig rig) {
  rig.driver.set_schedule({{100'000, {true, OperatorMode::kAutomatic, Task::kGrade, 0.5}}});
  rig.cycles(9);
  auto message = last<dozer_bus::OperatorCommand>(rig);
  assert_true(message.enable.value == dozer_bus::OperatorCommand::Enable::kOff);
  rig.cycles(2);
  message = last<dozer_bus::OperatorCommand>(rig);
  assert_true(message.enable.value == dozer_bus::OperatorCommand::Enable::kOn);
  assert_true(message.operator_mode.value == dozer_bus::OperatorCommand::OperatorMode::kAutomatic);
  assert_true(message.task.state == RawState::kValid);
  assert_true(message.task.value == dozer_bus::OperatorCommand::Task::kGrade);
  assert_near(message.speed_override_ratio.value, 0.5, 1e-9);
  rig.driver.set_silent(true);
  const std::size_t sent = rig.seen[dozer_bus::OperatorCommand::kId].size();
  rig.cycles(10);
  assert_int_equal(rig.seen[dozer_bus::OperatorCommand::kId].size(), sent);
}
