// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/blade.hpp"
#include "firmware/dozer/travel/tracks.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/dozer_fixture.hpp"

constexpr double kPerRpm = 6.28318530717958647693 / 60.0;

const DozerProfile& profile() { return test::dozer().profile; }

/// The paper: 1.8 m/s, 84.6 L/min at 1500 rpm.
TEST(the_papers_figures) {
  assert_near(track_speed_mps(profile().hst, 1500 * kPerRpm, 1.0, 1.0), 0.6298, 1e-4);
  assert_near(track_speed_max_mps(profile().hst, 1500 * kPerRpm), 1.80, 0.005);
  assert_near(available_flow_m3ps(profile().implement, 1500 * kPerRpm) * 60e3, 84.6, 1e-9);
}

TEST(flow_is_that_of_the_valve_where_the_pump_has_more) {
  assert_near(available_flow_m3ps(profile().implement, 4000 * kPerRpm),
              profile().implement.valve_flow_max_m3ps, 0.0);
  assert_near(available_flow_m3ps(profile().implement, -1.0), 0.0, 0.0);
}

/// (9) of its inverse is the speed that was asked for, the pump at its end before the motor moves.
TEST(the_inverse_is_the_inverse) {
  for (const double rpm : {900.0, 1500.0, 2200.0}) {
    const double most_mps = track_speed_max_mps(profile().hst, rpm * kPerRpm);
    for (double share = -1.0; share <= 1.0; share += 0.05) {
      const Displacements at = displacements_for(profile().hst, rpm * kPerRpm, share * most_mps);
      assert_near(track_speed_mps(profile().hst, rpm * kPerRpm, at.pump_ratio, at.motor_ratio),
                  share * most_mps, 1e-12);
      assert_true(at.motor_ratio == 1.0 || std::abs(at.pump_ratio) == 1.0);
    }
  }
}

TEST(beyond_the_fastest_it_gets_the_fastest) {
  for (const double sign : {-1.0, 1.0}) {
    const Displacements at = displacements_for(profile().hst, 157.0, sign * 99.0);
    assert_near(at.pump_ratio, sign, 0.0);
    assert_near(at.motor_ratio, profile().hst.motor_ratio_min, 0.0);
  }
}

TEST(an_engine_at_rest_drives_nothing) {
  const Displacements at = displacements_for(profile().hst, 0.0, 1.0);
  assert_near(at.pump_ratio, 0.0, 0.0);
  assert_near(at.motor_ratio, 1.0, 0.0);
  assert_near(track_speed_mps(profile().hst, 157.0, 1.0, 0.0), 0.0, 0.0);
}

/// (7): each way with the area that the oil enters, both cylinders.
TEST(inflow_is_that_of_the_side_it_enters) {
  assert_near(inflow_m3ps(profile().blade, 0.1), 0.1 * 2 * 0.25 * 3.14159265358979 * 0.0121, 1e-12);
  assert_near(inflow_m3ps(profile().blade, -0.1),
              0.1 * 2 * 0.25 * 3.14159265358979 * (0.0121 - 0.0036), 1e-12);
  assert_true(opening_for(profile(), 0.05) > 0.0);
  assert_true(opening_for(profile(), -0.05) < 0.0);
  assert_near(opening_for(profile(), -9.0), -1.0, 0.0);
  assert_near(std::abs(opening_for(profile(), -0.05)) * profile().implement.valve_flow_max_m3ps,
              inflow_m3ps(profile().blade, -0.05), 1e-15);
}

/// (8), (13): in a left turn the right track is the faster one and sets the limit.
TEST(a_turn_takes_speed_from_the_outer_track) {
  const auto speeds = track_speeds_mps(profile().body, 1.0, 0.5);
  assert_near(speeds[kLeft], 1.0 - 0.45, 1e-12);
  assert_near(speeds[kRight], 1.0 + 0.45, 1e-12);
  const auto most = body_speeds_max_mps(profile().body, {1.8, 1.8}, 0.5);
  assert_near(most[kRight], 1.8 - 0.45, 1e-12);
  assert_near(track_speeds_mps(profile().body, most[kRight], 0.5)[kRight], 1.8, 1e-12);
}

/// A track as a lag behind its displacements that loses a tenth on the way.
double settled_speed_mps(double wanted_mps, int cycles) {
  TrackState state;
  double speed_mps = 0.0;
  for (int n = 0; n < cycles; ++n) {
    const TrackCommand command =
        control_track(profile(), state, wanted_mps, speed_mps, 157.08, 0.01);
    state = command.state;
    const double given_mps =
        0.9 * track_speed_mps(profile().hst, 157.08, command.displacements.pump_ratio,
                              command.displacements.motor_ratio);
    speed_mps += 0.01 / 0.1 * (given_mps - speed_mps);
  }
  return speed_mps;
}

TEST(the_integral_makes_up_for_losses) {
  assert_near(settled_speed_mps(1.2, 500), 1.2, 1e-3);
  assert_near(settled_speed_mps(-0.5, 500), -0.5, 1e-3);
}

/// The usual lag behind a speed that falls, of oil and ground, is nothing to be made up for: the
/// machine would brake harder than it is told to.
TEST(the_lag_of_oil_is_not_made_up_for, TrackState state) {
  state.last_wanted_mps = 1.6;
  state.expected_mps = 1.6;
  double measured_mps = 1.6;
  for (int n = 1; n <= 40; ++n) {
    const double wanted_mps = 1.6 - 0.0125 * n;
    measured_mps += 0.01 / 0.13 * (wanted_mps - measured_mps);
    const TrackCommand command =
        control_track(profile(), state, wanted_mps, measured_mps, 157.08, 0.01);
    state = command.state;
    const double asked_mps = track_speed_mps(
        profile().hst, 157.08, command.displacements.pump_ratio, command.displacements.motor_ratio);
    assert_near(asked_mps, wanted_mps - 1.25 * profile().hst.response_s, 0.03);
  }
  assert_near(state.integral_mps, 0.0, 0.02);
}

/// What can't be had must not wind up.
TEST(out_of_reach_the_integral_stands_still, TrackState state) {
  repeat(1000, [&] { state = control_track(profile(), state, 5.0, 1.6, 157.08, 0.01).state; });
  assert_near(state.integral_mps, 0.0, 0.0);
}
