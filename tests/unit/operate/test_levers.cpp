// SPDX-License-Identifier: Apache-2.0
/// Sticks to levers to axes.

#include "app/operate/levers.hpp"

#include <array>

#include "tests/unit/cmocka_cpp.hpp"

using operate::Axes;
using operate::axes_of;
using operate::kDeadZone;
using operate::Levers;
using operate::stick_ratio;
using operate::StickRange;

constexpr StickRange kStick = {-32768, 32767, 128};
constexpr StickRange kByte = {0, 255, 0};
/// Half a step of the coarser one.
constexpr double kClose = 0.5 / 127.5;

TEST(ends_are_full_and_the_middle_is_rest) {
  assert_near(stick_ratio(32767, kStick), 1.0, 0.0);
  assert_near(stick_ratio(-32768, kStick), -1.0, 0.0);
  assert_near(stick_ratio(255, kByte), 1.0, 0.0);
  assert_near(stick_ratio(0, kByte), -1.0, 0.0);
  // A byte has no middle: both of its neighbours are at rest.
  for (const int raw : {127, 128, 127 + 15, 128 - 15}) {
    assert_near(stick_ratio(raw, kByte), 0.0, 0.0);
  }
  // A driver may tell what it never should.
  assert_near(stick_ratio(40000, kStick), 1.0, 0.0);
}

TEST(beyond_the_dead_zone_it_begins_at_zero) {
  constexpr double kHalf = 32767.5;
  const int edge = static_cast<int>(kDeadZone * kHalf);
  assert_near(stick_ratio(edge - 2, kStick), 0.0, 0.0);
  assert_true(stick_ratio(edge + 10, kStick) > 0.0);
  assert_near(stick_ratio(edge + 10, kStick), 0.0, 0.001);
  assert_near(stick_ratio(-edge - 10, kStick), 0.0, 0.001);
  assert_true(stick_ratio(-edge - 10, kStick) < 0.0);
}

TEST(half_the_way_is_expo) {
  // Half of what is left beyond the dead zone: 0.4 * 0.5 + 0.6 * 0.125.
  const double half_way = 0.5 + 0.5 * kDeadZone;
  assert_near(stick_ratio(static_cast<int>(half_way * 32767.5), kStick), 0.275, 0.001);
  assert_near(stick_ratio(-static_cast<int>(half_way * 32767.5), kStick), -0.275, 0.001);
  assert_near(stick_ratio(128 + static_cast<int>(half_way * 127.5), kByte), 0.275, kClose * 2.0);
}

TEST(it_rises_all_the_way) {
  double last = -2.0;
  for (int raw = -32768; raw <= 32767; raw += 257) {
    const double ratio = stick_ratio(raw, kStick);
    assert_true(ratio >= last && ratio >= -1.0 && ratio <= 1.0);
    last = ratio;
  }
}

TEST(the_drivers_flat_counts_if_it_is_larger) {
  assert_near(stick_ratio(40, {-100, 100, 50}), 0.0, 0.0);
  assert_true(stick_ratio(60, {-100, 100, 50}) > 0.0);
  assert_true(stick_ratio(40, {-100, 100, 0}) > 0.0);
  // A flat beyond the end leaves a stick that can still be moved.
  assert_near(stick_ratio(100, {-100, 100, 500}), 1.0, 1e-12);
}

TEST(a_range_that_is_none_is_at_rest) {
  assert_near(stick_ratio(7, {7, 7, 0}), 0.0, 0.0);
  assert_near(stick_ratio(7, {9, 3, 0}), 0.0, 0.0);
}

void check(const Axes& axes, double boom, double arm, double bucket, double swing) {
  assert_near(axes.boom_or_up_ratio, boom, 0.0);
  assert_near(axes.arm_or_forward_ratio, arm, 0.0);
  assert_near(axes.bucket_or_attitude_ratio, bucket, 0.0);
  assert_near(axes.swing_ratio, swing, 0.0);
}

/// As ISO 10968 has the levers of an excavator.
TEST(a_push_moves_as_on_an_excavator) {
  Levers levers;
  levers.left.away_ratio = 0.5;  // Arm out: the teeth go forward, the cylinder retracts.
  check(axes_of(levers, Task::kJog), 0.0, -0.5, 0.0, 0.0);
  check(axes_of(levers, Task::kAssist), 0.0, -0.5, 0.0, 0.0);
  check(axes_of(levers, Task::kCoordinated), 0.0, 0.5, 0.0, 0.0);
  levers = {};
  levers.left.right_ratio = 0.5;  // Swing to the right.
  check(axes_of(levers, Task::kJog), 0.0, 0.0, 0.0, -0.5);
  check(axes_of(levers, Task::kCoordinated), 0.0, 0.0, 0.0, -0.5);
  levers = {};
  levers.right.away_ratio = 0.5;  // Boom down.
  check(axes_of(levers, Task::kJog), -0.5, 0.0, 0.0, 0.0);
  check(axes_of(levers, Task::kCoordinated), -0.5, 0.0, 0.0, 0.0);
  levers = {};
  levers.right.right_ratio = 0.5;  // The bucket opens: the cylinder retracts.
  check(axes_of(levers, Task::kJog), 0.0, 0.0, -0.5, 0.0);
  check(axes_of(levers, Task::kCoordinated), 0.0, 0.0, 0.5, 0.0);
}

TEST(each_way_of_a_lever_ends_rest) {
  assert_true(Levers{}.are_at_rest());
  std::array<Levers, 4> pushed{};
  pushed[0].left.away_ratio = 0.01;
  pushed[1].left.right_ratio = -0.01;
  pushed[2].right.away_ratio = -0.01;
  pushed[3].right.right_ratio = 0.01;
  for (const Levers& levers : pushed) {
    assert_false(levers.are_at_rest());
  }
}
