// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/program/drive_plan.hpp"

#include <cmath>

#include "app/plant/random.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/fixture.hpp"

/// Round numbers: swing 1 rad/s left, 0.5 right.
DriveLimits round_limits() {
  DriveLimits limits;
  limits.speed_out = {0.2, 0.4, 0.5, 1.0};
  limits.speed_in = {0.4, 0.6, 1.0, 0.5};
  limits.acceleration = {0.5, 0.5, 0.5, 0.7};
  return limits;
}

double most_of_limits(const DriveLimits& limits, const DrivePlan& plan, bool acceleration) {
  double most = 0.0;
  constexpr int kMoments = 2000;
  for (int n = 0; n <= kMoments; ++n) {
    const DriveState state = drive_state(plan, plan.ramp.duration_s * n / kMoments);
    for (int i = 0; i < kDriveCount; ++i) {
      const double speed = state.velocity[i];
      const double speed_most = speed > 0.0 ? limits.speed_out[i] : limits.speed_in[i];
      most = std::max(most, acceleration ? std::abs(state.acceleration[i]) / limits.acceleration[i]
                                         : std::abs(speed) / speed_most);
    }
  }
  return most;
}

/// By hand: 0.8 m of boom out at 0.2 m/s; t_1 = pi v / (2 a), T = s / v + t_1.
TEST(one_drive_at_its_limits) {
  const DrivePlan plan =
      plan_drives(round_limits(), {0.1, 0.3, 0.3, 0.0}, {0.9, 0.3, 0.3, 0.0}, {});
  assert_near(plan.ramp.ramp_s, 0.62831853, 1e-8);
  assert_near(plan.ramp.duration_s, 4.62831853, 1e-8);
  const DriveState middle = drive_state(plan, 2.0);
  assert_near(middle.velocity[kBoom], 0.2, 1e-12);
  assert_near(middle.velocity[kArm], 0.0, 0.0);
  assert_near(most_of_limits(round_limits(), plan, true), 1.0, 1e-4);
}

TEST(the_way_back_has_its_own_limit) {
  const DrivePlan plan =
      plan_drives(round_limits(), {0.9, 0.3, 0.3, 0.4}, {0.1, 0.3, 0.3, 0.4}, {});
  assert_near(drive_state(plan, 0.5 * plan.ramp.duration_s).velocity[kBoom], -0.4, 1e-12);
  const DrivePlan right =
      plan_drives(round_limits(), {0.5, 0.5, 0.5, 1.5}, {0.5, 0.5, 0.5, 0.0}, {});
  assert_near(drive_state(right, 0.5 * right.ramp.duration_s).velocity[kSwing], -0.5, 1e-12);
}

/// 2 mm: half of it faster, half slower, T^2 = 2 pi s / a.
TEST(a_short_move_never_is_uniform) {
  const DrivePlan plan =
      plan_drives(round_limits(), {0.1, 0.3, 0.3, 0.0}, {0.102, 0.3, 0.3, 0.0}, {});
  assert_near(plan.ramp.duration_s, std::sqrt(2.0 * 3.14159265358979 * 0.002 / 0.5), 1e-9);
  assert_near(plan.ramp.ramp_s, 0.5 * plan.ramp.duration_s, 1e-12);
  assert_near(drive_state(plan, plan.ramp.duration_s).value[kBoom], 0.102, 1e-15);
}

/// Random moves: limits kept, one of them met; ends exact; on the straight line between them.
TEST(random_moves_meet_one_limit) {
  const DriveLimits limits = drive_limits(test::excavator_12t().profile);
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    plant::Random random(seed, plant::Draw::kStart);
    DriveVector from;
    DriveVector to;
    for (int i = 0; i < kDriveCount; ++i) {
      from[i] = random.uniform();
      to[i] = from[i] + (random.uniform() < 0.2 ? 0.0 : random.symmetric(0.5));
    }
    const double ratio = 0.05 + 0.95 * random.uniform();
    const DrivePlan plan = plan_drives(limits, from, to, {ratio, 0.0});
    if (from == to) {
      continue;
    }
    const double speed = most_of_limits(limits, plan, false);
    const double acceleration = most_of_limits(limits, plan, true);
    assert_true(speed <= ratio * 1.000001 && acceleration <= ratio * 1.000001);
    assert_true(std::max(speed, acceleration) > 0.999 * ratio);
    assert_true((drive_state(plan, -1.0).value - from).norm() < 1e-15);
    assert_true((drive_state(plan, 1e3).value - to).norm() < 1e-12);
    const DriveState third = drive_state(plan, plan.ramp.duration_s / 3.0);
    assert_true((third.value - from - third.progress.share * (to - from)).norm() < 1e-12);
  }
}

/// A longer duration is kept to the letter, a shorter one gives way to the limits.
TEST(the_longer_rule_holds) {
  const DriveLimits limits = round_limits();
  const DriveVector from(0.1, 0.3, 0.3, 0.0);
  const DriveVector to(0.9, 0.1, 0.8, 1.0);
  const double shortest_s = plan_drives(limits, from, to, {}).ramp.duration_s;
  assert_near(plan_drives(limits, from, to, {1.0, 0.5 * shortest_s}).ramp.duration_s, shortest_s,
              1e-12);
  const DrivePlan longer = plan_drives(limits, from, to, {1.0, 2.0 * shortest_s});
  assert_near(longer.ramp.duration_s, 2.0 * shortest_s, 1e-12);
  assert_true(most_of_limits(limits, longer, false) < 0.7);
  assert_true(most_of_limits(limits, longer, true) < 1.000001);
  // Half of speed and acceleration: twice the time of what is uniform, 1.41 times that of the rest.
  assert_true(plan_drives(limits, from, to, {0.5, 0.0}).ramp.duration_s > 1.41 * shortest_s);
}

TEST(velocities_are_differences) {
  constexpr double kStep_s = 1e-5;
  const DrivePlan plan =
      plan_drives(round_limits(), {0.1, 0.3, 0.3, 0.0}, {0.9, 0.1, 0.8, -1.0}, {0.7, 0.0});
  for (double t = 0.013; t < plan.ramp.duration_s; t += 0.1) {
    const DriveState here = drive_state(plan, t);
    const DriveState ahead = drive_state(plan, t + kStep_s);
    const DriveState behind = drive_state(plan, t - kStep_s);
    const DriveVector velocity = (ahead.value - behind.value) / (2.0 * kStep_s);
    const DriveVector acceleration = (ahead.velocity - behind.velocity) / (2.0 * kStep_s);
    assert_true((velocity - here.velocity).norm() < 1e-7);
    assert_true((acceleration - here.acceleration).norm() < 1e-3);
  }
}

TEST(nothing_to_move_has_no_duration) {
  const DriveVector here(0.1, 0.3, 0.3, 0.5);
  const DrivePlan plan = plan_drives(round_limits(), here, here, {1.0, 5.0});
  assert_near(plan.ramp.duration_s, 0.0, 0.0);
  assert_true(drive_state(plan, 1.0).value == here);
  assert_true(drive_state(plan, 1.0).velocity.isZero(0.0));
}
