// SPDX-License-Identifier: Apache-2.0
// The swing on the bus: what the machine says of it, what lets its spool open, what can be broken.

#include "app/plant/excavator_node.hpp"

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/plant/fixture/node_rig.hpp"
#include "tests/unit/plant/fixture/swing_rig.hpp"

using namespace graben::plant;
using namespace graben::plant::test;
using dbc::RawState;

TEST(frames_come_at_their_rates, SwingRig rig) {
  rig.cycles(200);
  assert_int_equal(rig.seen[bus::SwingState::kId].size(), 200);
  assert_int_equal(rig.seen[bus::SwingValveState::kId].size(), 100);
  Rig without;
  without.cycles(200);
  assert_int_equal(rig.seen.size(), without.seen.size() + 2);
  check_protection<bus::SwingState, bus::SwingValveState>(rig);
  // In the times between those of the pumps, as ValveState.
  assert_int_equal(rig.seen[bus::SwingValveState::kId].front().stamp_us, kCycleUs);
  assert_int_equal(rig.seen[bus::SwingValveState::kId].back().stamp_us,
                   rig.seen[bus::ValveState::kId].back().stamp_us);
}

TEST(without_the_drive_nothing_is_said_or_heard, Rig rig) {
  for (int i = 0; i < 50; ++i) {
    bus::SwingCommand message;
    message.enable.value = bus::SwingCommand::Enable::kOn;
    message.swing_duty_ratio.value = 0.5;
    assert_true(rig.our_port.send(rig.frame_of(message)));
    rig.send_and_cycle(rig.command(true, 0.5));
  }
  check_seen<bus::SwingState, bus::SwingValveState>(rig, 0);
  assert_int_equal(rig.machine.swing_counters().accepted, 0);
  assert_false(rig.machine.swing_enabled());
}

TEST(values_are_the_plants, SwingRig rig) {
  rig.command_for(151, true, true, -0.6);
  rig.cycle();
  const ExcavatorPlant& plant = rig.machine.plant();
  const auto state = last<bus::SwingState>(rig);
  assert_true(plant.swing_rad() < 0.2);
  // Encoder 0.1 mrad, bus 0.1 mrad and 1 kPa.
  assert_near(state.swing_angle_rad.value, plant.swing_rad(), 0.11e-3);
  const auto [left, right] = plant.swing_pressures_pa();
  assert_near(state.swing_left_pressure_pa.value, left, 501.0);
  assert_near(state.swing_right_pressure_pa.value, right, 501.0);
  assert_true(right > left + 1e6);
  assert_near(last<bus::SwingValveState>(rig).swing_spool_ratio.value, plant.swing_spool_ratio(),
              0.03e-3);
  assert_near(plant.swing_spool_ratio(), -0.6, 1e-3);
}

TEST(spool_opens_only_with_both_commands, SwingRig rig) {
  rig.command_for(30, true, true, 0.5);
  assert_true(rig.machine.spools_enabled() && rig.machine.swing_enabled());
  assert_near(rig.spool(), 0.5, 1e-3);
  rig.command_for(1, true, false, 0.5);
  assert_true(rig.machine.spools_enabled() && !rig.machine.swing_enabled());
  assert_true(rig.spool() < 0.48);
  rig.command_for(30, true, false, 0.5);
  assert_near(rig.spool(), 0.0, 1e-4);
  rig.command_for(30, true, true, 0.5);
  assert_near(rig.spool(), 0.5, 1e-3);
  rig.command_for(30, false, true, 0.5);
  assert_false(rig.machine.spools_enabled());
  assert_near(rig.spool(), 0.0, 1e-4);
  rig.command_for(30, true, true, -0.5);
  assert_near(rig.spool(), -0.5, 1e-3);
}

TEST(swing_alone_opens_nothing, SwingRig rig) {
  rig.cycles_of(30, [&] { rig.send_swing(true, 0.5); });
  assert_true(rig.machine.swing_enabled() && !rig.machine.spools_enabled());
  assert_near(rig.spool(), 0.0, 0.0);
}

TEST(silence_of_the_swings_command_is_neutral, SwingRig rig) {
  rig.command_for(30, true, true, 0.5);
  rig.cycles_of(9, [&] { rig.send_spool(true); });
  assert_near(rig.spool(), 0.5, 1e-3);
  rig.cycles_of(30, [&] { rig.send_spool(true); });
  assert_int_equal(rig.machine.swing_counters().timeouts, 1);
  assert_true(rig.machine.spools_enabled() && !rig.machine.swing_enabled());
  assert_near(rig.spool(), 0.0, 1e-4);
  // What comes first again must be an Off.
  rig.command_for(30, true, true, 0.5);
  assert_near(rig.spool(), 0.0, 1e-4);
  rig.command_for(1, true, false, 0.5);
  rig.command_for(30, true, true, 0.5);
  assert_near(rig.spool(), 0.5, 1e-3);
}

TEST(silence_of_the_other_command_is_neutral_too, SwingRig rig) {
  rig.command_for(30, true, true, 0.5);
  rig.cycles_of(40, [&] { rig.send_swing(true, 0.5); });
  assert_true(!rig.machine.spools_enabled() && rig.machine.swing_enabled());
  assert_near(rig.spool(), 0.0, 1e-4);
}

TEST(what_is_no_duty_is_neutral) {
  for (const RawState state : {RawState::kError, RawState::kNotAvailable}) {
    for (const bool of_enable : {false, true}) {
      SwingRig rig;
      rig.command_for(30, true, true, 0.5);
      for (int i = 0; i < 30; ++i) {
        bus::SwingCommand message = rig.swing(true, 0.5);
        (of_enable ? message.enable.state : message.swing_duty_ratio.state) = state;
        rig.send_spool(true);
        rig.send_and_cycle(rig.frame_of(message));
      }
      assert_false(rig.machine.swing_enabled());
      assert_near(rig.spool(), 0.0, 1e-4);
    }
  }
}

TEST(a_spoilt_command_does_not_count, SwingRig rig) {
  rig.command_for(30, true, true, 0.0);
  CanFrame frame = rig.frame_of(rig.swing(true, 0.5));
  frame.data[0] ^= 1U;
  rig.send_spool(true);
  rig.send_and_cycle(frame);
  assert_int_equal(rig.machine.swing_counters().rejected, 3);  // two while synchronising
  assert_near(rig.spool(), 0.0, 0.0);
}

TEST(sensors_of_the_swing_fail_as_told, SwingRig rig) {
  rig.cycles(5);
  SwingFaults& faults = rig.machine.faults().swing;
  faults.angle.jump_rad = 0.1;
  faults.left.rail_pa = 40e6;
  rig.cycle();
  assert_near(last<bus::SwingState>(rig).swing_angle_rad.value, 0.35, 0.11e-3);
  assert_near(last<bus::SwingState>(rig).swing_left_pressure_pa.value, 40e6, 0.0);
  faults.angle.jump_rad = 0.0;
  faults.angle.drift_radps = -0.5;
  rig.cycles(10);
  assert_near(last<bus::SwingState>(rig).swing_angle_rad.value, 0.20, 0.11e-3);
  faults.angle = {};
  faults.angle.stuck = true;
  faults.right.stuck = true;
  const double held_pa = last<bus::SwingState>(rig).swing_right_pressure_pa.value;
  rig.command_for(200, true, true, 0.6);
  assert_true(rig.machine.plant().swing_rad() > 0.5);
  assert_near(last<bus::SwingState>(rig).swing_angle_rad.value, 0.20, 0.11e-3);
  assert_near(last<bus::SwingState>(rig).swing_right_pressure_pa.value, held_pa, 501.0);
  faults.angle.state = RawState::kError;
  rig.cycle();
  assert_int_equal(last<bus::SwingState>(rig).swing_angle_rad.state, RawState::kError);
  rig.machine.faults().set_silent(bus::SwingState::kId, true);
  const std::size_t before = rig.seen[bus::SwingState::kId].size();
  rig.cycles(10);
  assert_int_equal(rig.seen[bus::SwingState::kId].size(), before);
}

TEST(spool_of_the_swing_fails_as_told, SwingRig rig) {
  rig.machine.faults().swing.spool_offset_ratio = 0.1;
  rig.cycles(50);
  assert_near(rig.spool(), 0.1, 1e-4);
  rig.machine.faults().swing.spool_held_ratio = 0.6;
  rig.command_for(50, true, true, -0.5);
  assert_near(rig.spool(), 0.6, 1e-4);
  for (int i = 0; i < 50; ++i) {
    bus::SpoolCommand message;
    message.pilot_cut = {bus::SpoolCommand::PilotCut::kOn, RawState::kValid};
    rig.send_and_cycle(rig.frame_of(message));
  }
  assert_near(rig.spool(), 0.0, 1e-4);
}

TEST(angle_sensor_counts_no_turns, SensorErrors errors) {
  errors.swing_resolution_rad = 1e-3;
  const SensorModel exact(errors, std::nullopt);
  assert_near(exact.swing_rad(3.0004), 3.0, 1e-12);
  assert_near(exact.swing_rad(3.2), 3.2 - 6.283185, 0.5e-3);
  assert_near(exact.swing_rad(-9.0), -9.0 + 6.283185, 0.5e-3);
  errors.swing_resolution_rad = 0.0;
  errors.swing_bias_rad = 0.01;
  double most = 0.0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const double off = SensorModel(errors, seed).swing_rad(0.5) - 0.5;
    assert_true(std::fabs(off) <= 0.01);
    most = std::max(most, std::fabs(off));
  }
  assert_true(most > 0.009);
}

TEST(operator_says_the_task_number, SwingRig rig) {
  rig.cycle();
  assert_int_equal(last<bus::OperatorCommand>(rig).task_number.value, 0);
  assert_int_equal(last<bus::OperatorCommand>(rig).task_number.state, RawState::kValid);
  OperatorRequest request;
  request.task = Task::kProgram;
  request.task_number = 7;
  rig.driver.set_schedule({{0, request}});
  rig.cycles(2);
  assert_int_equal(last<bus::OperatorCommand>(rig).task_number.value, 7);
  assert_int_equal(last<bus::OperatorCommand>(rig).task.value,
                   bus::OperatorCommand::Task::kProgram);
}
