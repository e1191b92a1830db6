// SPDX-License-Identifier: Apache-2.0
// The transmission against its commands, the tracks against the transmission, by the cycle. What
// comes of it in a machine: test_dozer_watch.cpp, test_dozer_tracks.cpp.

#include "firmware/dozer/safety/transmission_watch.hpp"

#include <cmath>

#include "firmware/dozer/safety/tuning.hpp"
#include "firmware/dozer/travel/tracks.hpp"
#include "firmware/numeric/constants.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/plain_dozer.hpp"

constexpr double kPeriod_s = 0.0625;

/// Both tracks at 1 m/s, as told and as (9) has it.
struct Machine {
  DozerProfile profile = test::plain_dozer();
  TransmissionWatchState state;
  SentRatios sent;
  DozerValid valid;
  DisplacementTask task = DisplacementTask::kFollow;

  Machine() {
    valid.engine_radps = 40.0;
    valid.motor_ratio = {1.0, 1.0};
    drive(0.5);
  }
  void drive(double pump_ratio) {
    sent.pump = valid.pump_ratio = {pump_ratio, pump_ratio};
    run_at(2.0 * pump_ratio);
  }
  /// The body and both tracks, whatever the displacements are.
  void run_at(double speed_mps) {
    valid.track_speed_mps = {speed_mps, speed_mps};
    valid.velocity_mps = speed_mps;
  }
  TransmissionWatchResult step(double period_s = kPeriod_s) {
    return watch_transmission(profile, state, sent, task, valid, period_s);
  }
  FaultSet run(int cycles) {
    FaultSet stops;
    for (int n = 0; n < cycles; ++n) {
      const TransmissionWatchResult result = step();
      stops = result.stops;
    }
    return stops;
  }
};

TEST(what_obeys_is_left_alone) {
  for (const double pump_ratio : {1.0, 0.5, 0.0, -0.5}) {
    Machine machine;
    machine.drive(pump_ratio);
    for (int n = 0; n < 100; ++n) {
      const TransmissionWatchResult result = machine.step();
      assert_false(result.tracks_disagree);
      assert_false(result.stops.has(Fault::kDisplacementDisagrees));
      assert_false(machine.valid.track_outvoted[kLeft] || machine.valid.track_outvoted[kRight]);
    }
    assert_true(machine.run(1).empty());
  }
}

/// Each of the four. Stays behind: 0.5 s are eight cycles.
TEST(each_displacement_is_watched) {
  for (unsigned track = 0; track < kTrackCount; ++track) {
    for (const bool motor : {false, true}) {
      Machine behind;
      behind.run(20);
      (motor ? behind.sent.motor : behind.sent.pump)[track] = 0.75;
      assert_true(behind.run(8).empty());
      const FaultSet disagrees = behind.run(1);
      assert_true(disagrees.has(Fault::kDisplacementDisagrees));
      assert_false(disagrees.has(Fault::kDisplacementRunaway));
      Machine away;
      away.run(20);
      (motor ? away.valid.motor_ratio : away.valid.pump_ratio)[track] = 0.75;
      assert_true(away.run(kRunawayCycles - 1).empty());
      assert_true(away.run(1).has(Fault::kDisplacementRunaway));
    }
  }
}

/// For longer than 0.3 s, standing by more than the tolerance; a tenth of the speed more otherwise.
TEST(a_track_off_its_displacements_disagrees) {
  for (const double sign : {1.0, -1.0}) {
    Machine machine;
    machine.drive(0.0);
    machine.run_at(sign * 0.375);
    assert_false(machine.step(0.5).tracks_disagree);
    machine.run_at(std::nextafter(sign * 0.375, sign));
    assert_false(machine.step(0.3).tracks_disagree);
    assert_true(machine.step(1e-9).tracks_disagree);
    machine.run_at(0.0);
    assert_false(machine.step().tracks_disagree);
  }
}

/// In this cycle already; said after more than 0.1 s.
TEST(a_sensor_that_nothing_confirms_is_outvoted) {
  for (unsigned track = 0; track < kTrackCount; ++track) {
    for (const double sign : {1.0, -1.0}) {
      Machine machine;
      machine.drive(0.0);
      machine.valid.track_speed_mps[track] = sign * 0.15;
      machine.step(1e-3);
      assert_false(machine.valid.track_outvoted[track]);
      machine.valid.track_speed_mps[track] = std::nextafter(sign * 0.15, sign);
      assert_false(machine.step(0.1).tracks_disagree);
      assert_true(machine.valid.track_outvoted[track]);
      assert_false(machine.valid.track_outvoted[1 - track]);
      assert_true(machine.step(1e-9).tracks_disagree);
    }
  }
}

TEST(one_that_agrees_with_a_sensor_is_enough, Machine like_body) {
  like_body.run_at(1.3);
  static_cast<void>(like_body.step());
  assert_false(like_body.valid.track_outvoted[kLeft]);
  Machine like_transmission;
  like_transmission.valid.velocity_mps = 3.0;
  static_cast<void>(like_transmission.step());
  assert_false(like_transmission.valid.track_outvoted[kLeft]);
}

/// The body's speed is that along the slope.
TEST(on_a_slope_the_body_is_faster_than_its_position, Machine machine) {
  machine.valid.pitch_rad = 0.75;
  machine.valid.velocity_mps = 1.5 * std::cos(0.75);
  machine.valid.track_speed_mps = {1.9, 1.9};  // 0.45 m/s beside 1.5.
  static_cast<void>(machine.step());
  assert_false(machine.valid.track_outvoted[kLeft]);
}

/// For more than 0.2 s by more than 0.1 m/s, either side and way, and a twentieth of the speed.
TEST(sides_apart_disagree) {
  for (unsigned track = 0; track < kTrackCount; ++track) {
    for (const double sign : {1.0, -1.0}) {
      Machine machine;
      machine.drive(0.0);
      machine.valid.track_speed_mps[track] = sign * 0.1;
      assert_false(machine.step(0.5).tracks_disagree);
      machine.valid.track_speed_mps[track] = std::nextafter(sign * 0.1, sign);
      assert_false(machine.step(0.2).tracks_disagree);
      assert_true(machine.step(1e-9).tracks_disagree);
      machine.valid.velocity_mps = -0.01;
      assert_false(machine.step().tracks_disagree);
    }
  }
}

/// (9) of a track.
double expected_mps(const Machine& machine) {
  return track_speed_mps(machine.profile.hst, machine.valid.engine_radps,
                         machine.valid.pump_ratio[kLeft], machine.valid.motor_ratio[kLeft]);
}

bool engine_is_doubtful(Machine machine, double for_s) {
  return machine.step(for_s).stops.has(Fault::kEngineDoubtful);
}

/// Both tracks and the body, for more than 0.3 s, either way; not when they have run since.
TEST(what_stands_though_it_should_run_has_no_engine) {
  for (const double way : {1.0, -1.0}) {
    Machine machine;
    machine.drive(way * 0.5);
    machine.run_at(0.0);
    assert_true(machine.step(0.3).stops.empty());
    assert_true(machine.step(1e-9).stops.has(Fault::kEngineDoubtful));
    machine.run_at(way);
    assert_true(machine.step().stops.empty());
    machine.run_at(0.0);
    assert_true(machine.step(0.3).stops.empty());
    // Backwards is no better.
    machine.run_at(-0.05 * way);
    assert_true(machine.step(1e-9).stops.has(Fault::kEngineDoubtful));
  }
}

/// Each track, at less than 0.3 of (9); a slower one says nothing.
TEST(both_have_to_stand) {
  for (unsigned track = 0; track < kTrackCount; ++track) {
    for (const double way : {1.0, -1.0}) {
      Machine machine;
      machine.drive(way * 0.125);
      machine.run_at(0.0);
      const double least_mps = 0.3 * expected_mps(machine);
      machine.valid.track_speed_mps[track] = least_mps;
      assert_false(engine_is_doubtful(machine, 0.4));
      machine.valid.track_speed_mps[track] = std::nextafter(least_mps, -way);
      assert_true(engine_is_doubtful(machine, 0.4));
    }
  }
}

/// Above 0.1 m/s of (9).
TEST(what_is_hardly_stroked_may_stand) {
  for (unsigned track = 0; track < kTrackCount; ++track) {
    Machine machine;
    machine.drive(0.5);
    machine.run_at(0.0);
    machine.sent.pump[track] = machine.valid.pump_ratio[track] = 0.05 - 1e-9;
    assert_false(engine_is_doubtful(machine, 0.4));
    machine.sent.pump[track] = machine.valid.pump_ratio[track] = 0.05 + 1e-9;
    assert_true(engine_is_doubtful(machine, 0.4));
  }
  Machine machine;
  machine.drive(0.05);
  machine.run_at(0.0);
  assert_near(expected_mps(machine), kTrackStandsFrom_mps, 0.0);
  assert_false(engine_is_doubtful(machine, 0.4));
}

/// By 0.1 m/s and 0.3 of a track's speed; below each track its own.
TEST(the_body_has_to_go_along) {
  for (const double way : {1.0, -1.0}) {
    Machine machine;
    machine.run_at(0.0);
    machine.valid.velocity_mps = way * 0.1;
    assert_true(engine_is_doubtful(machine, 0.4));
    machine.valid.velocity_mps = std::nextafter(way * 0.1, way);
    assert_false(engine_is_doubtful(machine, 0.4));
    Machine turning;
    turning.run_at(0.0);
    turning.profile.body.half_gauge_m = 1.0;
    turning.valid.course.yaw_rate_radps = way * 0.09;
    assert_true(engine_is_doubtful(turning, 0.4));
    turning.valid.velocity_mps = 0.05;  // One side 0.04, the other 0.14.
    assert_false(engine_is_doubtful(turning, 0.4));
  }
}

/// A line's pressure, in both, that pushes with so much, N.
double pushing_pa(double force_n) { return 2.5e6 + force_n / (2.0 * 1e-4 / kTwoPi * 10.0 / 0.5); }

/// With a twentieth of the weight beyond what the slope takes.
TEST(a_load_may_hold_the_tracks) {
  for (const double pitch_rad : {0.0, 0.25, -0.25}) {
    Machine machine;
    machine.profile.body.mass_kg = 1000.0;
    machine.run_at(0.0);
    machine.valid.pitch_rad = pitch_rad;
    const double most_n = 1000.0 * kStandardGravity_mps2 * (0.05 + std::abs(std::sin(pitch_rad)));
    machine.valid.line_pressure_pa = {pushing_pa(most_n - 1.0), pushing_pa(most_n - 1.0)};
    assert_true(engine_is_doubtful(machine, 0.4));
    machine.valid.line_pressure_pa = {pushing_pa(most_n + 1.0), pushing_pa(most_n + 1.0)};
    assert_false(engine_is_doubtful(machine, 0.4));
  }
}

/// Beyond what a track may be off for 0.3 s, 0.375 m/s and a tenth: both, and the body with them.
/// Under pressure too.
TEST(both_tracks_and_body_faster_than_the_transmission_are_astray) {
  for (const double way : {1.0, -1.0}) {
    for (const double line_pa : {2.5e6, 10e6}) {
      Machine machine;
      machine.drive(way * 0.5);
      machine.valid.line_pressure_pa = {line_pa, line_pa};
      machine.run_at(way * 1.5);
      assert_true(machine.step(0.3).stops.empty());
      const FaultSet stops = machine.step(1e-9).stops;
      assert_true(stops.has(Fault::kTracksAstray));
      assert_true(stops.has(Fault::kDisplacementRunaway));
      assert_false(stops.has(Fault::kEngineDoubtful));
      // Slower may be losses, or a load.
      machine.run_at(way * 0.5);
      assert_true(machine.step(0.4).stops.empty());
      assert_true(machine.step(1e-9).tracks_disagree);
    }
    // As fast, the other way.
    Machine reversed;
    reversed.drive(way * 0.5);
    reversed.run_at(-expected_mps(reversed));
    assert_true(reversed.step(0.4).stops.has(Fault::kTracksAstray));
  }
}

TEST(astray_is_both_to_one_side_with_the_body) {
  for (unsigned track = 0; track < kTrackCount; ++track) {
    Machine one;
    one.run_at(1.5);
    one.valid.track_speed_mps[track] = 1.45;
    assert_true(one.step(0.4).stops.empty());
  }
  Machine alone;
  alone.run_at(1.5);
  alone.valid.velocity_mps = 0.9;
  assert_true(alone.step(0.4).stops.empty());
  // Turning on the spot, about as fast as it drives.
  Machine apart;
  apart.valid.track_speed_mps = {0.5, 1.5};
  apart.profile.body.half_gauge_m = 1.0;
  apart.valid.course.yaw_rate_radps = 0.5;
  assert_true(apart.step(0.4).stops.empty());
}

/// Neither after motion, nor without a task, nor without an engine speed; nothing is kept.
TEST(tracks_are_judged_where_they_can_be) {
  const auto off = [](Machine& machine) {
    machine.valid.track_speed_mps = {3.0, 1.0};
    static_cast<void>(machine.step(1.0));
  };
  for (const DisplacementTask task : {DisplacementTask::kNone, DisplacementTask::kReturn}) {
    Machine machine;
    off(machine);
    machine.task = task;
    assert_false(machine.step(1.0).tracks_disagree);
    machine.task = DisplacementTask::kFollow;
    assert_false(machine.step(0.01).tracks_disagree);
    assert_true(machine.step(1.0).tracks_disagree);
  }
  Machine machine;
  off(machine);
  machine.valid.faults.add(Fault::kEngineSpeedMissing);
  assert_false(machine.step(1.0).tracks_disagree);
  machine.valid.faults = {};
  assert_false(machine.step(0.01).tracks_disagree);
  // Nor that they have stood.
  Machine stood;
  stood.run_at(0.0);
  static_cast<void>(stood.step(0.3));
  stood.task = DisplacementTask::kReturn;
  static_cast<void>(stood.step(0.01));
  stood.task = DisplacementTask::kFollow;
  assert_true(stood.step(0.1).stops.empty());
}

TEST(the_transmission_speaks_for_both_tracks, Machine machine) {
  machine.valid.pump_ratio = {0.5, 0.25};
  machine.valid.track_speed_mps = {1.5, 0.75};
  GroundSpeeds speeds = ground_speeds(machine.profile, machine.valid);
  assert_near(speeds.left_mps, 1.5, 0.0);
  assert_near(speeds.right_mps, 0.75, 0.0);
  assert_near(speeds.transmission_mps, 0.75, 1e-15);
  machine.valid.faults.add(Fault::kEngineSpeedMissing);
  speeds = ground_speeds(machine.profile, machine.valid);
  assert_near(speeds.right_mps, 0.75, 0.0);
  assert_near(speeds.transmission_mps, 1.5, 0.0);
}

/// The nearer to the body of two sound sensors, and of one that is outvoted its transmission.
TEST(the_better_track_speaks_for_the_way, Machine machine) {
  machine.valid.track_speed_mps = {1.25, 1.125};
  assert_near(ground_speeds(machine.profile, machine.valid).way_mps, 1.125, 0.0);
  machine.valid.track_speed_mps = {1.0625, 1.125};
  assert_near(ground_speeds(machine.profile, machine.valid).way_mps, 1.0625, 0.0);
  machine.valid.track_speed_mps = {3.0, 3.0};
  machine.valid.track_outvoted = {true, true};
  assert_near(ground_speeds(machine.profile, machine.valid).way_mps, 1.0, 1e-12);
  machine.valid.faults.add(Fault::kEngineSpeedMissing);
  assert_near(ground_speeds(machine.profile, machine.valid).way_mps, 3.0, 0.0);
}

TEST(traction_is_a_share_of_the_weight, Machine machine) {
  machine.profile.body.mass_kg = 1000.0;
  assert_near(ground_speeds(machine.profile, machine.valid).traction_share, 0.0, 0.0);
  machine.valid.line_pressure_pa = {12.5e6, 12.5e6};
  const double share = ground_speeds(machine.profile, machine.valid).traction_share;
  assert_near(share, 2.0 * 10e6 * 1e-4 / kTwoPi * 10.0 / 0.5 / (1000.0 * kStandardGravity_mps2),
              1e-9);
}

TEST(both_pumps_have_to_be_neutral) {
  for (unsigned track = 0; track < kTrackCount; ++track) {
    for (const double sign : {1.0, -1.0}) {
      Machine machine;
      machine.drive(0.0);
      assert_true(pumps_neutral(machine.profile, machine.valid));
      machine.valid.pump_ratio[track] = sign * 0.125;
      assert_true(pumps_neutral(machine.profile, machine.valid));
      machine.valid.pump_ratio[track] = std::nextafter(sign * 0.125, sign);
      assert_false(pumps_neutral(machine.profile, machine.valid));
    }
  }
}

/// 0.1 m/s and a fifth of the speed instead of a twentieth, for longer than 0.2 s.
TEST(sides_may_be_further_apart_where_the_track_bends) {
  static const double level_m[] = {0.0, 0.0};
  static const double curvature_1pm[] = {0.0625, 0.0625};
  for (const bool bends : {false, true}) {
    const double most_mps = bends ? 0.1 + 0.2 : 0.1 + 0.05;
    for (const double off_mps : {most_mps - 1e-9, most_mps + 1e-9}) {
      Machine machine;
      machine.profile.grade.heights.count = 2;
      machine.profile.grade.heights.height_m = level_m;
      machine.profile.grade.heights.curvature = bends ? curvature_1pm : nullptr;
      machine.valid.track_speed_mps[kLeft] += off_mps / 2.0;
      machine.valid.track_speed_mps[kRight] -= off_mps / 2.0;
      machine.step(0.2);
      assert_int_equal(machine.step(1e-9).tracks_disagree, off_mps > most_mps);
    }
  }
}
