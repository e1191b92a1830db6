// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/program/drive_plan.hpp"

#include "tests/unit/cmocka_cpp.hpp"

constexpr double kPi = 3.14159265358979323846;

/// (7) as printed, but for the range of its last line.
double share_of_7(const SineRamp& ramp, double t) {
  const double w = kPi / ramp.ramp_s;
  const double a = ramp.peak_rate_change_ps2();
  const double t1 = ramp.ramp_s;
  const double t2 = ramp.duration_s - ramp.ramp_s;
  const double s1 = a / w * t1;
  const double s2 = s1 + 2.0 * a / w * (t2 - t1);
  if (t <= t1) {
    return a / w * (t - std::sin(w * t) / w);
  }
  if (t <= t2) {
    return s1 + 2.0 * a / w * (t - t1);
  }
  return s2 + a / w * (t - t2 + std::sin(w * (t - t2)) / w);
}

TEST(share_is_the_paper_s) {
  for (const SineRamp ramp : {SineRamp{18.4, 1.5}, SineRamp{3.0, 1.5}}) {
    for (double t = 0.0; t <= ramp.duration_s; t += 0.01) {
      assert_near(ramp.at(t).share, share_of_7(ramp, t), 1e-12);
    }
  }
}

TEST(rates_are_its_derivatives) {
  constexpr double kStep_s = 1e-5;
  const SineRamp ramp{10.0, 2.0};
  double fastest = 0.0;
  double hardest = 0.0;
  for (double t = 0.013; t < 10.0; t += 0.0137) {
    const Progress here = ramp.at(t);
    const Progress ahead = ramp.at(t + kStep_s);
    const Progress behind = ramp.at(t - kStep_s);
    assert_near(here.rate_ps, (ahead.share - behind.share) / (2.0 * kStep_s), 1e-8);
    assert_near(here.rate_change_ps2, (ahead.rate_ps - behind.rate_ps) / (2.0 * kStep_s), 1e-5);
    fastest = std::max(fastest, here.rate_ps);
    hardest = std::max(hardest, here.rate_change_ps2);
  }
  assert_near(fastest, ramp.peak_rate_ps(), 1e-12);
  assert_near(hardest, ramp.peak_rate_change_ps2(), 1e-4);
}

TEST(at_rest_at_both_ends_and_beyond) {
  const SineRamp ramp{10.0, 2.0};
  for (const double t : {-1.0, 0.0}) {
    assert_near(ramp.at(t).share, 0.0, 0.0);
    assert_near(ramp.at(t).rate_ps, 0.0, 0.0);
  }
  for (const double t : {10.0, 11.0}) {
    assert_near(ramp.at(t).share, 1.0, 0.0);
    assert_near(ramp.at(t).rate_ps, 0.0, 0.0);
  }
  assert_near(SineRamp{}.at(1.0).share, 0.0, 0.0);
}

/// One is the other's inverse.
TEST(duration_and_speed) {
  const SineRamp timed = ramp_for_duration(3.73, 18.4, 0.25);
  assert_near(timed.duration_s, 18.4, 0.0);
  assert_near(3.73 * timed.peak_rate_change_ps2(), 0.25, 1e-12);
  const SineRamp paced = ramp_for_speed(3.73, 3.73 * timed.peak_rate_ps(), 0.25);
  assert_near(paced.duration_s, 18.4, 1e-9);
  assert_near(paced.ramp_s, timed.ramp_s, 1e-9);
}

/// Half of the time faster, half slower, at the whole acceleration; the speed is not reached.
TEST(a_short_trip_never_is_uniform) {
  const SineRamp trip = ramp_for_speed(0.1, 1.0, 0.25);
  assert_near(trip.ramp_s, 0.5 * trip.duration_s, 0.0);
  assert_near(0.1 * trip.peak_rate_change_ps2(), 0.25, 1e-12);
  assert_true(0.1 * trip.peak_rate_ps() < 1.0);
  // The longest way that is one: speed times ramp.
  const double longest_m = 0.5 * kPi / 0.25;
  assert_near(ramp_for_speed(1.0001 * longest_m, 1.0, 0.25).peak_rate_ps() * 1.0001 * longest_m,
              1.0, 1e-12);
  assert_true(ramp_for_speed(0.99 * longest_m, 1.0, 0.25).peak_rate_ps() * 0.99 * longest_m < 1.0);
}

TEST(too_little_time_takes_the_shortest_there_is) {
  const SineRamp ramp = ramp_for_duration(1.0, 0.1, 0.25);
  assert_near(ramp.duration_s, std::sqrt(2.0 * kPi / 0.25), 1e-12);
  assert_near(ramp.peak_rate_change_ps2(), 0.25, 1e-12);
}

TEST(slower_in_proportion) {
  const SineRamp ramp{10.0, 2.0};
  const SineRamp slow = ramp.slowed(1.5);
  assert_near(slow.peak_rate_ps(), ramp.peak_rate_ps() / 1.5, 1e-15);
  assert_near(slow.peak_rate_change_ps2(), ramp.peak_rate_change_ps2() / 2.25, 1e-15);
  assert_near(slow.at(4.5).share, ramp.at(3.0).share, 1e-15);
}

/// By the share alone: never less than by the time, and the peak where that is.
TEST(the_rate_at_a_share_is_bounded) {
  for (const SineRamp& ramp : {SineRamp{4.0, 1.0}, SineRamp{4.0, 2.0}}) {
    for (int i = 0; i <= 400; ++i) {
      const Progress at = ramp.at(0.01 * i);
      assert_true(ramp.most_rate_ps(at.share) >= at.rate_ps - 1e-12);
    }
    assert_near(ramp.most_rate_ps(0.5), ramp.peak_rate_ps(), 1e-12);
    assert_near(ramp.most_rate_ps(0.0), 0.0, 0.0);
    assert_near(ramp.most_rate_ps(1.0), 0.0, 0.0);
  }
}
