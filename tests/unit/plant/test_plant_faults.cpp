// SPDX-License-Identifier: Apache-2.0
// What the machine does beside spools and sensors that are well: pilot cut, pump commands, faults.

#include "app/plant/excavator_faults.hpp"
#include "tests/unit/plant/fixture/node_rig.hpp"

using namespace graben::plant;
using namespace graben::plant::test;
namespace bus = dbc::excavator;
using dbc::RawState;

constexpr double kSet = 0.643;  // the profile's swash

TEST(valve_state_is_the_plants, Rig rig) {
  rig.command_for(32, true, 0.5);
  auto valve = last<bus::ValveState>(rig);
  const auto spool = rig.machine.plant().spool_travels_ratio();
  assert_int_equal(valve.enabled.value, bus::ValveState::Enabled::kOn);
  assert_near(valve.boom_spool_ratio.value, 0.5, 1e-3);  // of the whole travel
  assert_near(valve.boom_spool_ratio.value, spool[kBoom], 1e-4);
  assert_near(valve.arm_spool_ratio.value, spool[kArm], 1e-4);
  assert_near(valve.bucket_spool_ratio.value, spool[kBucket], 1e-4);
  rig.command_for(2, false, 0.5);
  valve = last<bus::ValveState>(rig);
  assert_int_equal(valve.enabled.value, bus::ValveState::Enabled::kOff);
  assert_true(valve.boom_spool_ratio.value > 0.3);  // enable is off, the spool on its way
}

void pump_for(Rig& rig, int cycles, dbc::Physical one, dbc::Physical two) {
  for (int i = 0; i < cycles; ++i) {
    if (i % 2 == 0) {
      assert_true(rig.our_port.send(rig.frame_of(bus::PumpCommand{one, two})));
    }
    rig.cycle();
  }
}

constexpr dbc::Physical kNotCommanded{0.0, RawState::kNotAvailable};
dbc::Physical swash_of(double ratio) { return {ratio, RawState::kValid}; }

TEST(pumps_follow_their_commands, Rig rig) {
  pump_for(rig, 4, swash_of(0.5), swash_of(0.3));
  assert_near(rig.machine.plant().swash_ratios()[0], kSet, 0.0);  // not confirmed yet
  pump_for(rig, 10, swash_of(0.5), swash_of(0.3));
  // 100 ms are one time constant.
  assert_near(rig.machine.plant().swash_ratios()[0], 0.5 + (kSet - 0.5) * std::exp(-1.0), 1e-6);
  assert_near(rig.machine.plant().swash_ratios()[1], 0.3 + (kSet - 0.3) * std::exp(-1.0), 1e-6);
  pump_for(rig, 200, swash_of(0.5), swash_of(0.3));
  assert_near(last<bus::PumpState>(rig).pump1_swash_ratio.value, 0.5, 1e-5);
  assert_near(last<bus::PumpState>(rig).pump2_swash_ratio.value, 0.3, 1e-5);
  // It is the flow that follows.
  const auto flow = rig.machine.plant().pump_flows_m3ps();
  assert_near(flow[1] / flow[0], 0.6, 0.02);
  pump_for(rig, 200, kNotCommanded, swash_of(0.3));
  assert_near(rig.machine.plant().swash_ratios()[0], kSet, 1e-6);
  assert_near(rig.machine.plant().swash_ratios()[1], 0.3, 1e-6);
  assert_int_equal(rig.machine.pump_counters().timeouts, 0);
}

TEST(pumps_go_back_without_a_command, Rig rig) {
  pump_for(rig, 201, swash_of(0.3), swash_of(0.3));  // the last one came in the last cycle
  rig.cycles(9);
  assert_near(rig.machine.plant().swash_ratios()[0], 0.3, 1e-6);
  rig.cycle();
  assert_true(rig.machine.plant().swash_ratios()[0] > 0.31);
  assert_int_equal(rig.machine.pump_counters().timeouts, 1);
  rig.cycles(200);
  assert_near(rig.machine.plant().swash_ratios()[0], kSet, 1e-6);
}

TEST(wrong_pump_commands_are_refused, Rig rig) {
  for (int i = 0; i < 20; ++i) {
    CanFrame frame = rig.frame_of(bus::PumpCommand{swash_of(0.3), swash_of(0.3)});
    frame.data[3] = static_cast<std::uint8_t>(frame.data[3] ^ 1U);
    rig.send_and_cycle(frame);
    rig.cycle();
  }
  assert_near(rig.machine.plant().swash_ratios()[0], kSet, 0.0);
  assert_int_equal(rig.machine.pump_counters().rejected, 20);
  assert_int_equal(rig.machine.counters().rejected, 0);
}

// A command of what the profile sets changes nothing, to the last bit.
TEST(the_set_swash_as_command_is_no_change, Rig commanded) {
  Rig left;
  for (int i = 0; i < 100; ++i) {
    if (i % 2 == 0) {
      assert_true(commanded.our_port.send(
          commanded.frame_of(bus::PumpCommand{swash_of(kSet), swash_of(kSet)})));
    }
    commanded.command_for(1, true, 0.5);
    left.command_for(1, true, 0.5);
  }
  assert_true(commanded.machine.pump_counters().accepted > 40);
  assert_near(commanded.machine.plant().strokes_m()[kBoom], left.machine.plant().strokes_m()[kBoom],
              0.0);
}

CanFrame cut_command(Rig& rig, dbc::excavator::SpoolCommand::PilotCut cut, RawState state) {
  bus::SpoolCommand message;
  message.enable.value = bus::SpoolCommand::Enable::kOn;
  message.boom_duty_ratio.value = 0.5;
  message.pilot_cut = {cut, state};
  return rig.frame_of(message);
}

TEST(a_held_spool_obeys_the_pilot_cut_only) {
  using Cut = bus::SpoolCommand::PilotCut;
  Rig rig;
  rig.machine.faults().axis[kBoom].spool_held_ratio = 0.3;
  rig.command_for(30, true, -0.5);
  assert_near(rig.boom_spool(), 0.3, 1e-3);
  rig.command_for(30, false, 0.0);
  assert_near(rig.boom_spool(), 0.3, 1e-6);
  repeat(30, [&] { rig.send_and_cycle(cut_command(rig, Cut::kOn, RawState::kValid)); });
  assert_near(rig.boom_spool(), 0.0, 1e-4);
  // Neither an unusable value nor silence ends the cut.
  rig.send_and_cycle(cut_command(rig, Cut::kOff, RawState::kError));
  assert_false(rig.machine.spools_enabled());
  rig.cycles(30);
  assert_near(rig.boom_spool(), 0.0, 1e-4);
  // After a silence the valve side wants Off once.
  rig.command_for(4, false, 0.0);
  repeat(33, [&] { rig.send_and_cycle(cut_command(rig, Cut::kOff, RawState::kValid)); });
  assert_near(rig.boom_spool(), 0.3, 1e-3);
  rig.machine.faults().axis[kBoom].spool_held_ratio.reset();
  repeat(60, [&] { rig.send_and_cycle(cut_command(rig, Cut::kOff, RawState::kValid)); });
  assert_near(rig.boom_spool(), 0.5, 1e-3);
}

TEST(a_spool_opens_uncommanded, Rig rig) {
  rig.machine.faults().axis[kBoom].spool_offset_ratio = 0.2;
  rig.cycles(30);
  assert_near(rig.boom_spool(), 0.2, 1e-3);
  rig.command_for(40, true, 0.5);
  assert_near(rig.boom_spool(), 0.7, 1e-3);
  assert_near(rig.machine.plant().spool_travels_ratio()[kArm], 0.0, 0.0);
}

double shown_boom(const Rig& rig) { return last<bus::BoomStroke>(rig).boom_stroke_m.value; }

TEST(stroke_sensors_fail_in_their_ways, Rig rig) {
  rig.command_for(30, true, 0.5);
  StrokeFault& fault = rig.machine.faults().axis[kBoom].stroke;
  const double before_m = shown_boom(rig);
  fault.stuck = true;
  rig.command_for(30, true, 0.5);
  assert_near(shown_boom(rig), before_m, 0.0);
  assert_true(rig.machine.plant().strokes_m()[kBoom] > before_m + 0.002);
  fault = {};
  rig.command_for(1, true, 0.5);
  assert_near(shown_boom(rig), rig.machine.plant().strokes_m()[kBoom], 1e-4);
  fault.jump_m = 0.05;
  rig.command_for(1, true, 0.5);
  assert_near(shown_boom(rig), rig.machine.plant().strokes_m()[kBoom] + 0.05, 1e-4);
  fault = {};
  fault.drift_mps = -0.1;
  rig.command_for(50, true, 0.5);
  assert_near(shown_boom(rig), rig.machine.plant().strokes_m()[kBoom] - 0.05, 1e-4);
  fault = {};
  rig.command_for(1, true, 0.5);
  assert_near(shown_boom(rig), rig.machine.plant().strokes_m()[kBoom], 1e-4);
}

TEST(pressure_sensors_fail_in_their_ways, Rig rig) {
  rig.cycle();
  const auto before = last<bus::BoomPressure>(rig);
  rig.machine.faults().axis[kBoom].cap.stuck = true;
  rig.machine.faults().axis[kBoom].rod.rail_pa = 25e6;
  rig.command_for(60, true, -0.5);
  auto shown = last<bus::BoomPressure>(rig);
  assert_near(shown.boom_cap_pressure_pa.value, before.boom_cap_pressure_pa.value, 0.0);
  assert_near(shown.boom_rod_pressure_pa.value, 25e6, 0.0);
  rig.machine.faults().axis[kBoom] = {};
  rig.machine.faults().axis[kBoom].cap.rail_pa = 0.0;
  rig.machine.faults().axis[kBoom].rod.stuck = true;
  rig.command_for(2, true, -0.5);
  shown = last<bus::BoomPressure>(rig);
  assert_near(shown.boom_cap_pressure_pa.value, 0.0, 0.0);
  assert_true(shown.boom_rod_pressure_pa.value < 25e6);
  rig.machine.faults().axis[kBoom] = {};
  rig.command_for(1, true, -0.5);
  shown = last<bus::BoomPressure>(rig);
  assert_near(shown.boom_cap_pressure_pa.value, rig.machine.plant().cap_pressures_pa()[0], 501.0);
}

TEST(swash_and_its_feedback_fail, Rig rig) {
  rig.machine.faults().pump[0].shown_swash_ratio = 0.9;
  rig.machine.faults().pump[1].actual_swash_ratio = 0.2;
  pump_for(rig, 200, swash_of(0.5), swash_of(0.5));
  assert_near(rig.machine.plant().swash_ratios()[0], 0.5, 1e-6);
  assert_near(rig.machine.plant().swash_ratios()[1], 0.2, 1e-6);
  assert_near(last<bus::PumpState>(rig).pump1_swash_ratio.value, 0.9, 1e-5);
  assert_near(last<bus::PumpState>(rig).pump2_swash_ratio.value, 0.2, 1e-5);
}

TEST(identity_can_be_wrong, Rig rig) {
  rig.machine.faults().wrong_identity = true;
  rig.cycle();
  assert_int_not_equal(last<bus::MachineIdentity>(rig).profile_hash.value, kHash);
  rig.machine.faults().wrong_identity = false;
  rig.cycles(100);
  assert_int_equal(last<bus::MachineIdentity>(rig).profile_hash.value, kHash);
}

TEST(commands_can_be_lost, Rig rig) {
  rig.command_for(30, true, 0.5);
  rig.machine.faults().loses_spool_commands = true;
  rig.command_for(10, true, 0.5);
  assert_false(rig.machine.spools_enabled());
  rig.machine.faults().loses_spool_commands = false;
  rig.command_for(3, true, 0.5);
  assert_false(rig.machine.spools_enabled());
  // After a silence the valve side wants Off once.
  rig.command_for(1, false, 0.0);
  rig.command_for(1, true, 0.5);
  assert_true(rig.machine.spools_enabled());
}

TEST(counters_can_freeze, Rig rig) {
  rig.cycles(10);
  rig.machine.faults().set_frozen_counter(bus::ArmStroke::kId, true);
  rig.cycles(10);
  const auto& arm = rig.seen[bus::ArmStroke::kId];
  assert_int_equal(arm.size(), 20);
  assert_int_equal(counter_of(arm[10]), 10);
  assert_int_equal(counter_of(arm[19]), 10);
  assert_true(e2e_crc_fits(arm[19].data, bus::ArmStroke::kDataId));
  assert_int_equal(counter_of(rig.seen[bus::BoomStroke::kId][19]), 19 % 15);
  rig.machine.faults().set_frozen_counter(bus::ArmStroke::kId, false);
  rig.cycles(2);
  assert_int_equal(counter_of(rig.seen[bus::ArmStroke::kId][21]), 11);
}

TEST(data_ids_can_be_swapped, Rig rig) {
  rig.machine.faults().frames.swapped_data_ids = {bus::BoomStroke::kId, bus::ArmStroke::kId};
  rig.cycle();
  const auto fits = [&rig](std::uint32_t id, std::uint16_t data_id) {
    return e2e_crc_fits(rig.seen[id].back().data, data_id);
  };
  assert_true(fits(bus::BoomStroke::kId, bus::ArmStroke::kDataId));
  assert_true(fits(bus::ArmStroke::kId, bus::BoomStroke::kDataId));
  assert_true(fits(bus::BucketStroke::kId, bus::BucketStroke::kDataId));
  rig.machine.faults().frames.swapped_data_ids.reset();
  rig.cycle();
  assert_true(fits(bus::BoomStroke::kId, bus::BoomStroke::kDataId));
}

TEST(the_stream_can_be_late, Rig rig) {
  rig.cycles(10);
  rig.machine.faults().frames.delay_us = 200 * kMillisecondUs;
  rig.cycles(20);
  assert_int_equal(rig.seen[bus::BoomStroke::kId].size(), 10);
  rig.cycles(5);
  const auto& frames = rig.seen[bus::BoomStroke::kId];
  assert_int_equal(frames.size(), 15);
  assert_int_equal(counter_of(frames[10]), 10);
  assert_int_equal(frames[10].stamp_us, 300 * kMillisecondUs);
  rig.machine.faults().frames.delay_us = 0;
  rig.cycles(1);
  assert_int_equal(frames.size(), 16);  // what was under way is lost
  assert_int_equal(counter_of(frames[15]), 35 % 15);
}
