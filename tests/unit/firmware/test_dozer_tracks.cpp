// SPDX-License-Identifier: Apache-2.0
// Tracks and pose against the transmission.

#include "tests/unit/firmware/dozer_watch_machine.hpp"

using namespace graben::test::of_dozer;

/// What is faster has to stop: it does not get slower by being told to.
void assert_off(bool faster, const DozerValid& inputs) {
  if (!faster) {
    assert_slowed_by(Fault::kTrackSpeedDisagrees, inputs);
    return;
  }
  assert_true(inputs.fault != Fault::kNone);
  assert_true(inputs.faults.has(Fault::kTrackSpeedDisagrees));
  assert_true(inputs.faults.has(Fault::kTracksAstray));
}

/// At 1 m/s 0.475 m/s for 0.3 s, either way; a moment of agreement gives as much again. Both tracks
/// and the body alike: losses that the profile has wrong, or what their displacements say is.
TEST(tracks_off_their_displacements_slow_or_stop) {
  for (const double sign : {1.0, -1.0}) {
    Machine machine;
    machine.run_at(1.0 + sign * 0.474);
    assert_well(machine.run(50));
    machine.run_at(1.0 + sign * 0.476);
    for (int round = 0; round < 3; ++round) {
      assert_well(machine.run(4));  // 0.25 s
      machine.run_at(1.0);
      assert_well(machine.step());
      machine.run_at(1.0 + sign * 0.476);
    }
    machine.run(4);
    assert_off(sign > 0.0, machine.step());
  }
}

/// Standing, the tolerance itself is well and the next number is not; backwards its share counts as
/// forwards.
TEST(the_tracks_tolerance_grows_with_speed) {
  for (const double sign : {1.0, -1.0}) {
    Machine machine;
    machine.drive(0.0, 1.0);
    machine.run_at(sign * 0.375);
    assert_well(machine.run(50));
    machine.run_at(std::nextafter(sign * 0.375, sign * 9.0));
    assert_off(true, machine.run(5));
    Machine back;
    back.drive(-0.5, 1.0);
    back.run_at(-1.0 + sign * 0.474);
    assert_well(back.run(50));
    back.run_at(-1.0 + sign * 0.476);
    assert_off(sign < 0.0, back.run(5));
  }
}

/// What it ought to be follows engine and both displacements; without the engine's speed there is
/// nothing to compare with.
TEST(a_tracks_speed_is_that_of_its_displacements, Machine fast) {
  fast.drive(1.0, 0.5);  // 4 m/s
  assert_well(fast.run(50));
  fast.inputs.engine_radps = 20.0;
  fast.run_at(2.0);
  assert_well(fast.run(50));
  fast.run_at(4.0);
  fast.inputs.faults.add(Fault::kEngineSpeedMissing);
  assert_false(fast.run(50).faults.has(Fault::kTrackSpeedDisagrees));
  fast.inputs.faults = {};
  assert_off(true, fast.run(5));
}

/// Neither its displacements nor the body say what the sensor does: not used from this cycle on,
/// told after 0.1 s. At 1 m/s 0.25 m/s beside the one and 0.35 beside the other.
TEST(a_sensor_is_outvoted) {
  for (unsigned track = 0; track < kTrackCount; ++track) {
    for (const double off_mps : {-1.0, -0.351, 0.351, 2.0}) {
      Machine machine;
      machine.run(3);
      machine.inputs.track_speed_mps[track] = 1.0 + off_mps;
      assert_well(machine.step());
      assert_true(machine.seen.track_outvoted[track]);
      assert_false(machine.seen.track_outvoted[1 - track]);
      assert_slowed_by(Fault::kTrackSpeedDisagrees, machine.step());
      machine.inputs.track_speed_mps[track] = 1.0;
      assert_false(machine.step().track_outvoted[track]);
    }
  }
}

/// One that agrees with it is enough.
TEST(one_vote_for_a_sensor_is_enough) {
  for (const double sign : {1.0, -1.0}) {
    Machine like_body;
    like_body.run_at(1.0 + sign * 0.349);
    like_body.inputs.track_speed_mps = {1.0 + sign * 0.351, 1.0 + sign * 0.351};
    assert_false(like_body.step().track_outvoted[kLeft]);
    Machine like_transmission;
    like_transmission.run_at(1.0 + sign * 2.0);
    like_transmission.inputs.track_speed_mps = {1.0 + sign * 0.249, 1.0 + sign * 0.249};
    assert_false(like_transmission.step().track_outvoted[kRight]);
    like_transmission.inputs.track_speed_mps = {1.0 + sign * 0.251, 1.0 + sign * 0.251};
    assert_true(like_transmission.step().track_outvoted[kRight]);
  }
  // Slip is a share of the body's speed.
  Machine fast;
  fast.drive(1.0, 1.0);
  fast.inputs.track_speed_mps = {2.549, 2.549};
  assert_false(fast.step().track_outvoted[kLeft]);
  fast.inputs.track_speed_mps = {2.551, 2.551};
  assert_true(fast.step().track_outvoted[kLeft]);
}

/// One side further from its displacements than the other, though each is within its tolerance: at
/// 1 m/s 0.15 m/s for 0.2 s.
TEST(sides_that_are_apart_slow) {
  for (unsigned track = 0; track < kTrackCount; ++track) {
    for (const double sign : {1.0, -1.0}) {
      Machine machine;
      machine.inputs.track_speed_mps[track] = 1.0 + sign * 0.149;
      assert_well(machine.run(50));
      machine.inputs.track_speed_mps[track] = 1.0 + sign * 0.151;
      assert_well(machine.run(3));
      assert_slowed_by(Fault::kTrackSpeedDisagrees, machine.step());
    }
  }
}

/// Nothing of it is kept over a time in which it is not looked at.
TEST(votes_are_counted_in_motion_only, Machine machine) {
  machine.inputs.track_speed_mps[kLeft] = 0.0;
  machine.step();
  machine.cycle.drives.moving = false;
  machine.inputs.fault = Fault::kNone;
  machine.step();
  machine.cycle.drives.moving = true;
  assert_well(machine.step());
}

TEST(a_pose_that_does_not_fit_stops, Machine machine) {
  machine.run(3);
  machine.frozen = true;
  assert_stopped_by(Fault::kPoseDisagrees, machine.step());
  // Not judged outside motion, and begun newly.
  machine.cycle.drives.moving = false;
  assert_false(machine.run(5).faults.has(Fault::kPoseDisagrees));
  machine.cycle.drives.moving = true;
  machine.frozen = false;
  assert_false(machine.run(5).faults.has(Fault::kPoseDisagrees));
  // Nor with a fault that stops anyway.
  machine.frozen = true;
  machine.inputs.fault = Fault::kPoseMissing;
  assert_false(machine.run(5).faults.has(Fault::kPoseDisagrees));
}

/// Without an engine speed only the tracks speak of the body's speed.
TEST(the_engines_speed_may_be_missing, Machine machine) {
  machine.inputs.faults.add(Fault::kEngineSpeedMissing);
  machine.inputs.engine_radps = 4.0;
  assert_false(machine.run(20).faults.has(Fault::kPoseDisagrees));
  for (const double tracks_mps : {2.0, -1.0}) {
    machine.inputs.track_speed_mps = {tracks_mps, tracks_mps};
    assert_true(machine.run(20).faults.has(Fault::kPoseDisagrees));
    machine.state.pose = {};
  }
}
