// SPDX-License-Identifier: Apache-2.0
// The dozer's fault switches, as the bus and the machine show them.

#include "app/plant/dozer_faults.hpp"
#include "tests/unit/plant/fixture/dozer_rig.hpp"

using namespace graben::plant;
using namespace graben::plant::test;
using dbc::RawState;

double shown_stroke(const DozerRig& rig) {
  return last<dozer_bus::BladeStroke>(rig).blade_stroke_m.value;
}

TEST(the_stroke_sensor_fails_in_its_ways, DozerRig rig) {
  rig.spool_for(30, true, -0.5);
  StrokeFault& fault = rig.machine.faults().stroke;
  const double before_m = shown_stroke(rig);
  fault.stuck = true;
  rig.spool_for(30, true, -0.5);
  assert_near(shown_stroke(rig), before_m, 0.0);
  assert_true(rig.machine.plant().blade_stroke_m() < before_m - 0.005);
  fault = {};
  fault.jump_m = 0.05;
  rig.spool_for(1, true, -0.5);
  assert_near(shown_stroke(rig), rig.machine.plant().blade_stroke_m() + 0.05, 1e-4);
  fault = {};
  fault.drift_mps = 0.02;
  rig.spool_for(50, true, -0.5);
  assert_near(shown_stroke(rig), rig.machine.plant().blade_stroke_m() + 0.01, 1e-4);
  fault = {};
  fault.state = RawState::kError;
  rig.spool_for(1, true, -0.5);
  assert_true(last<dozer_bus::BladeStroke>(rig).blade_stroke_m.state == RawState::kError);
  fault = {};
  rig.spool_for(1, true, -0.5);
  assert_near(shown_stroke(rig), rig.machine.plant().blade_stroke_m(), 1e-4);
}

TEST(the_spool_can_be_held_or_open_uncommanded, DozerRig rig) {
  rig.machine.faults().spool_offset_ratio = 0.25;
  rig.spool_for(30, true, 0.3);
  assert_near(rig.blade_spool(), 0.55, 1e-3);
  rig.machine.faults().spool_held_ratio = -0.5;
  rig.spool_for(40, true, 0.3);
  assert_near(rig.blade_spool(), -0.5, 1e-3);
  rig.machine.faults().spool_held_ratio.reset();
  rig.machine.faults().spool_offset_ratio = 0.0;
  rig.spool_for(60, true, 0.3);
  assert_near(rig.blade_spool(), 0.3, 1e-3);
}

struct Pose {
  std::array<dbc::Physical, 6> signal;
};

Pose pose_on(const DozerRig& rig) {
  const auto position = last<dozer_bus::BodyPosition>(rig);
  const auto pitch = last<dozer_bus::BodyPitch>(rig);
  const auto velocity = last<dozer_bus::BodyVelocity>(rig);
  return {{position.position_m, position.height_m, pitch.pitch_rad, velocity.forward_mps,
           velocity.climb_mps, pitch.pitch_rate_radps}};
}

std::array<double, 6> truth_of(const DozerRig& rig) {
  const DozerPlant& plant = rig.machine.plant();
  return {plant.position_m(),   plant.height_m(),  plant.pitch_rad(),
          plant.velocity_mps(), plant.climb_mps(), plant.pitch_rate_radps()};
}

std::array<ReadingFault*, 6> faults_of(PoseFaults& pose) {
  return {&pose.position, &pose.height, &pose.pitch, &pose.velocity, &pose.climb, &pose.pitch_rate};
}

// Each switch at its own signal and at no other.
TEST(each_signal_of_the_pose_fails_alone, DozerRig rig) {
  rig.pumps_for(50, false, 0.5, 0.5);
  const std::array<ReadingFault*, 6> faults = faults_of(rig.machine.faults().pose);
  for (std::size_t which = 0; which < faults.size(); ++which) {
    faults[which]->jump = 0.2;
    rig.pumps_for(1, false, 0.5, 0.5);
    for (std::size_t i = 0; i < faults.size(); ++i) {
      assert_near(pose_on(rig).signal[i].value, truth_of(rig)[i] + (i == which ? 0.2 : 0.0), 3e-4);
    }
    *faults[which] = {};
    faults[which]->state = RawState::kNotAvailable;
    rig.pumps_for(1, false, 0.5, 0.5);
    for (std::size_t i = 0; i < faults.size(); ++i) {
      assert_true(pose_on(rig).signal[i].state ==
                  (i == which ? RawState::kNotAvailable : RawState::kValid));
    }
    *faults[which] = {};
  }
  rig.machine.faults().pose.position.stuck = true;
  const double shown = pose_on(rig).signal[0].value;
  rig.pumps_for(50, false, 0.5, 0.5);
  assert_near(pose_on(rig).signal[0].value, shown, 0.0);
  assert_true(rig.machine.plant().position_m() > shown + 0.1);
}

// With noise every reading changes each time: the one that is stuck does not.
TEST(each_signal_of_the_pose_sticks_alone) {
  DozerPlantProfile profile = dozer_9t();
  profile.sensor_errors = true;
  profile.seed = 3;
  DozerRig rig(profile);
  rig.cycles(3);
  const std::array<ReadingFault*, 6> faults = faults_of(rig.machine.faults().pose);
  for (std::size_t which = 0; which < faults.size(); ++which) {
    const Pose before = pose_on(rig);
    faults[which]->stuck = true;
    std::array<bool, 6> moved{};
    for (int i = 0; i < 20; ++i) {
      rig.cycle();
      for (std::size_t k = 0; k < moved.size(); ++k) {
        moved[k] = moved[k] || pose_on(rig).signal[k].value != before.signal[k].value;
      }
    }
    for (std::size_t k = 0; k < moved.size(); ++k) {
      assert_true(moved[k] == (k != which));
    }
    *faults[which] = {};
  }
}

TEST(the_whole_pose_can_be_lost, DozerRig rig) {
  rig.machine.faults().pose.set_state(RawState::kError);
  rig.cycle();
  for (const dbc::Physical& signal : pose_on(rig).signal) {
    assert_true(signal.state == RawState::kError);
  }
  rig.machine.faults().pose.set_state(RawState::kValid);
  rig.cycle();
  for (const dbc::Physical& signal : pose_on(rig).signal) {
    assert_true(signal.state == RawState::kValid);
  }
}

TEST(displacements_can_run_away_and_be_shown_wrong, DozerRig rig) {
  PathFaults& left = rig.machine.faults().path[kLeft];
  PathFaults& right = rig.machine.faults().path[kRight];
  left.pump.held_ratio = 0.9;
  right.pump.reversed = true;
  right.motor.held_ratio = 0.6;
  rig.pumps_for(100, true, 0.3, 0.3);
  assert_near(rig.left_pump(), 0.9, 1e-3);
  assert_near(rig.right_pump(), -0.3, 1e-3);
  assert_near(last<dozer_bus::LeftTransmission>(rig).pump_ratio.value, 0.9, 1e-3);
  assert_near(last<dozer_bus::RightTransmission>(rig).motor_ratio.value, 0.6, 1e-3);
  left.pump = {};
  right.pump = {};
  right.motor = {};
  right.pump.offset_ratio = 0.2;
  left.shown_pump_ratio = 0.11;
  right.shown_motor_ratio = 0.44;
  rig.pumps_for(100, true, 0.3, 0.3);
  assert_near(rig.left_pump(), 0.3, 1e-3);
  assert_near(rig.right_pump(), 0.5, 1e-3);
  assert_near(last<dozer_bus::LeftTransmission>(rig).pump_ratio.value, 0.11, 1e-4);
  assert_near(last<dozer_bus::LeftTransmission>(rig).motor_ratio.value, 1.0, 1e-4);
  assert_near(last<dozer_bus::RightTransmission>(rig).pump_ratio.value, 0.5, 1e-3);
  assert_near(last<dozer_bus::RightTransmission>(rig).motor_ratio.value, 0.44, 1e-4);
}

TEST(both_pumps_can_stay_and_say_so_or_not, DozerRig rig) {
  DozerFaults& faults = rig.machine.faults();
  const auto shown = [&] { return last<dozer_bus::LeftTransmission>(rig).pump_ratio.value; };
  rig.pumps_for(100, true, 0.5, 0.25);
  faults.pumps_stay = true;
  rig.pumps_for(100, true, 0.25, 0.5);
  assert_near(rig.left_pump(), 0.5, 1e-3);
  assert_near(rig.right_pump(), 0.25, 1e-3);
  assert_near(shown(), 0.5, 1e-3);
  faults.pump_feedback_echoes = true;
  rig.pumps_for(100, true, 0.25, 0.5);
  assert_near(rig.left_pump(), 0.5, 1e-3);
  assert_near(shown(), 0.25, 1e-4);
  faults.pump_feedback_stuck = true;
  faults.pumps_stay = false;
  rig.pumps_for(100, true, 0.75, 0.75);
  assert_near(rig.left_pump(), 0.75, 1e-3);
  assert_near(shown(), 0.25, 1e-4);
  faults.pump_feedback_stuck = faults.pump_feedback_echoes = false;
  rig.pumps_for(1, true, 0.75, 0.75);
  assert_near(shown(), 0.75, 1e-3);
}

/// By 0.1 s a second: after 1 s it is where it was 0.1 s before, and its velocity is that of then.
TEST(the_pose_can_come_later_and_later, DozerRig rig) {
  rig.pumps_for(300, false, 0.5, 0.5);
  const auto late_m = [&] {
    return rig.machine.plant().position_m() - last<dozer_bus::BodyPosition>(rig).position_m.value;
  };
  assert_near(late_m(), 0.0, 1e-3);
  rig.machine.faults().pose.later_ps = 0.1;
  rig.pumps_for(100, false, 0.5, 0.5);
  assert_near(late_m(), 0.1 * rig.machine.plant().velocity_mps(), 2e-3);
  rig.machine.faults().pose.later_ps = 0.0;
  rig.pumps_for(1, false, 0.5, 0.5);
  assert_near(late_m(), 0.0, 1e-3);
}

TEST(the_engine_s_speed_can_freeze, DozerRig rig) {
  rig.pumps_for(10, false, 0.0, 0.0);
  const auto shown = [&] { return last<dozer_bus::EEC1>(rig).engine_speed_radps.value; };
  const double before_radps = shown();
  rig.machine.faults().engine_speed.stuck = true;
  rig.machine.faults().engine_ratio = 0.0;
  rig.pumps_for(10, false, 0.0, 0.0);
  assert_near(shown(), before_radps, 0.0);
  assert_true(before_radps > 100.0);
  rig.machine.faults().engine_speed = {};
  rig.pumps_for(2, false, 0.0, 0.0);
  assert_near(shown(), 0.0, 0.0);
}

TEST(track_speeds_can_be_shown_wrong, DozerRig rig) {
  rig.pumps_for(100, false, 0.5, 0.5);
  rig.machine.faults().path[kLeft].speed.stuck = true;
  rig.machine.faults().path[kRight].speed.jump = -0.4;
  const double shown = last<dozer_bus::TrackSpeed>(rig).left_track_mps.value;
  rig.pumps_for(100, false, 0.1, 0.1);
  assert_near(last<dozer_bus::TrackSpeed>(rig).left_track_mps.value, shown, 0.0);
  assert_near(last<dozer_bus::TrackSpeed>(rig).right_track_mps.value,
              rig.machine.plant().track_speeds_mps()[kRight] - 0.4, 1e-4);
  rig.machine.faults().path[kLeft].speed = {};
  rig.machine.faults().path[kLeft].speed.state = RawState::kError;
  rig.pumps_for(1, false, 0.1, 0.1);
  assert_true(last<dozer_bus::TrackSpeed>(rig).left_track_mps.state == RawState::kError);
  assert_true(last<dozer_bus::TrackSpeed>(rig).right_track_mps.state == RawState::kValid);
}

TEST(commands_can_be_lost, DozerRig rig) {
  rig.spool_for(10, true, 0.5);
  rig.machine.faults().loses_spool_commands = true;
  rig.spool_for(10, true, 0.5);
  assert_false(rig.machine.spools_enabled());
  rig.pumps_for(30, false, 0.5, 0.5);
  assert_true(rig.left_pump() > 0.4);
  rig.machine.faults().loses_displacement_commands = true;
  rig.pumps_for(100, false, 0.5, 0.5);
  assert_near(rig.left_pump(), 0.0, 1e-3);
  assert_true(rig.braked());
  assert_int_equal(rig.machine.pump_counters().timeouts, 1);
}

TEST(frames_can_be_spoilt, DozerRig rig) {
  DozerFaults& faults = rig.machine.faults();
  rig.cycles(10);
  faults.set_frozen_counter(dozer_bus::BladeStroke::kId, true);
  faults.set_silent(dozer_bus::TrackSpeed::kId, true);
  faults.frames.swapped_data_ids = {dozer_bus::BodyPitch::kId, dozer_bus::BodyVelocity::kId};
  rig.cycles(10);
  assert_int_equal(counter_of(rig.seen[dozer_bus::BladeStroke::kId][19]), 10);
  assert_int_equal(rig.seen[dozer_bus::TrackSpeed::kId].size(), 10);
  const auto fits = [&rig](std::uint32_t id, std::uint16_t data_id) {
    return e2e_crc_fits(rig.seen[id].back().data, data_id);
  };
  assert_true(fits(dozer_bus::BodyPitch::kId, dozer_bus::BodyVelocity::kDataId));
  assert_true(fits(dozer_bus::BodyVelocity::kId, dozer_bus::BodyPitch::kDataId));
  assert_true(fits(dozer_bus::BodyPosition::kId, dozer_bus::BodyPosition::kDataId));
  faults.frames = {};
  faults.frames.delay_us = 200 * kMillisecondUs;
  rig.cycles(20);
  assert_int_equal(rig.seen[dozer_bus::BodyPosition::kId].size(), 20);
  rig.cycles(5);
  assert_int_equal(rig.seen[dozer_bus::BodyPosition::kId].size(), 25);
  faults.frames.delay_us = 0;
  faults.wrong_identity = true;
  rig.cycles(100);
  assert_int_not_equal(last<dozer_bus::MachineIdentity>(rig).profile_hash.value, kHash);
}

TEST(noise_comes_from_the_seed) {
  DozerPlantProfile profile = dozer_9t();
  profile.sensor_errors = true;
  profile.seed = 5;
  DozerRig one(profile);
  DozerRig same(profile);
  profile.seed = 6;
  DozerRig other(profile);
  bool differs = false;
  for (int i = 0; i < 100; ++i) {
    one.cycle();
    same.cycle();
    other.cycle();
    const double height = last<dozer_bus::BodyPosition>(one).height_m.value;
    assert_near(last<dozer_bus::BodyPosition>(same).height_m.value, height, 0.0);
    differs = differs || last<dozer_bus::BodyPosition>(other).height_m.value != height;
    assert_near(height, 0.0, 0.002 + 6 * 0.0015);
  }
  assert_true(differs);
}
