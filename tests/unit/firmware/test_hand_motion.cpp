// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/hand/hand_motion.hpp"

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/excavator_steps.hpp"
#include "tests/unit/firmware/fixture.hpp"
#include "tests/unit/firmware/hand.hpp"

using test::Hand;

constexpr double kPeriod_s = test::kHandPeriod_s;
constexpr TipPose kStart = test::kHandStart;
constexpr double kDrift_m = 2e-3;  ///< Of steps of 10 ms that nothing corrects.

const ExcavatorProfile& profile() { return test::excavator().profile; }

TEST(at_rest_nothing_is_wanted) {
  for (const Task task : {Task::kJog, Task::kCoordinated}) {
    Hand hand(task);
    hand.run(0.2);
    assert_true(hand.want.wanted_mps.isZero(0.0));
    assert_false(hand.want.moves || hand.state.plans);
  }
}

/// A lever that is held when the task begins has to come to rest first.
TEST(a_held_lever_moves_nothing) {
  for (const Task task : {Task::kJog, Task::kCoordinated}) {
    Hand hand(task);
    hand.state = {};
    hand.ask.lever_ratio[kArm] = 1.0;
    hand.run(0.5);
    assert_true(hand.want.wanted_mps.isZero(0.0));
    hand.ask.lever_ratio[kArm] = 0.0;
    hand.step();
    hand.ask.lever_ratio[kArm] = 1.0;
    hand.run(0.5);
    assert_false(hand.want.wanted_mps.isZero(0.0));
  }
}

/// What the pump's flow makes of the cap side: 0.158, 0.232, 0.316 m/s, reached by 0.5 m/s2.
TEST(full_lever_is_what_the_pump_gives) {
  const double most_mps[] = {0.158, 0.232, 0.316};
  for (int axis = 0; axis < kAxisCount; ++axis) {
    for (const double side : {1.0, -1.0}) {
      Hand hand(Task::kJog);
      hand.strokes_m << 0.7, 0.7, 0.5;
      hand.ask.lever_ratio[static_cast<unsigned>(axis)] = side;
      hand.step();
      assert_near(hand.want.wanted_mps[axis], side * 0.005, 1e-12);
      hand.run(0.7);
      assert_near(hand.want.wanted_mps[axis], side * most_mps[axis], 1e-3);
      assert_near(hand.want.wanted_mps.cwiseAbs().sum(), most_mps[axis], 1e-3);
      hand.ask.lever_ratio = {};
      hand.step();
      assert_near(hand.want.wanted_mps[axis], side * (most_mps[axis] - 0.005), 1e-3);
    }
  }
}

TEST(the_operators_speed_counts) {
  for (const Task task : {Task::kJog, Task::kCoordinated}) {
    Hand whole(task);
    Hand half(task);
    half.ask.speed_override_ratio = 0.5;
    whole.ask.lever_ratio[kArm] = half.ask.lever_ratio[kArm] = 1.0;
    whole.run(1.0);
    half.run(1.0);
    assert_near(half.want.speed[kArm], 0.5 * whole.want.speed[kArm], 1e-12);
    half.ask.lever_ratio[kArm] = 7.0;
    half.run(1.0);
    assert_near(half.want.speed[kArm], 0.5 * whole.want.speed[kArm], 1e-12);
  }
}

/// Up, forward, opening; a tenth of a second in the direction asked for, and in no other.
TEST(teeth_go_where_the_levers_say) {
  for (const double side : {1.0, -1.0}) {
    for (const unsigned lever : {0U, 1U, 2U}) {
      Hand hand(Task::kCoordinated);
      hand.ask.lever_ratio[lever] = side;
      hand.run(0.8);
      const double moved[] = {hand.tip().y_m - kStart.y_m, hand.tip().x_m - kStart.x_m,
                              hand.tip().attitude_rad - kStart.attitude_rad};
      for (const unsigned axis : {0U, 1U, 2U}) {
        if (axis == lever) {
          assert_true(side * moved[axis] > 0.2);
        } else {
          assert_near(moved[axis], 0.0, kDrift_m);
        }
      }
    }
  }
}

/// Both together are no faster than one, from the first cycle on in one direction.
TEST(a_diagonal_is_a_line) {
  Hand hand(Task::kCoordinated);
  hand.ask.lever_ratio = {1.0, 1.0, 0.0, 0.0};
  for (int n = 0; n < 150; ++n) {
    hand.step();
    assert_near(hand.want.speed[0], hand.want.speed[1], 1e-12);
  }
  assert_near(hand.want.speed.head<2>().norm(), profile().dig_speed_mps, 1e-9);
  assert_near(hand.tip().y_m - kStart.y_m, hand.tip().x_m - kStart.x_m, kDrift_m);
}

/// What lambda slows waits where it is: the plan goes no further than the machine can.
TEST(the_plan_waits_for_the_machine) {
  Hand hand(Task::kCoordinated);
  hand.followed = 0.3;
  hand.ask.lever_ratio[1] = 1.0;
  hand.run(1.5);
  assert_near(hand.state.tip.x_m, hand.tip().x_m, 1e-4);
  assert_near(hand.state.tip.y_m, kStart.y_m, 1e-12);
  assert_near(hand.tip().y_m, kStart.y_m, 1e-4);
  // A machine that does not move is waited for.
  Hand stuck(Task::kCoordinated);
  stuck.ask.lever_ratio[1] = 1.0;
  const Eigen::Vector3d held_m = stuck.strokes_m;
  for (int n = 0; n < 300; ++n) {
    stuck.step();
    stuck.strokes_m = held_m;
  }
  assert_true(stuck.want.error_m > 0.05 && stuck.want.error_m < 0.3);
  assert_true(stuck.state.pace_ratio < 0.1);
}

/// One drive's end is no other's.
TEST(a_drive_slows_before_its_own_end) {
  Hand hand(Task::kJog);
  hand.strokes_m[kBoom] = profile().geometry.cylinder[kBoom].stroke_m - 0.05;
  hand.ask.lever_ratio = {1.0, 0.0, -0.5, 0.0};
  hand.run(0.5);
  assert_true(hand.want.wanted_mps[kBoom] < 0.1);
  assert_near(hand.want.wanted_mps[kBucket], -0.158, 1e-3);
  assert_int_equal(hand.want.cap.limit.kind, LimitKind::kStrokeEnd);
  assert_int_equal(hand.want.cap.limit.index, kBoom);
  hand.run(3.0);
  assert_true(hand.want.wanted_mps[kBoom] < 1e-3);
  hand.ask.lever_ratio[kBoom] = -1.0;
  hand.run(0.1);
  assert_true(hand.want.wanted_mps[kBoom] < -0.04);
}

/// Forward until an arm's end: all slow, on their line; back is free.
TEST(a_line_ends_before_an_end) {
  Hand hand(Task::kCoordinated);
  hand.ask.lever_ratio[1] = 1.0;
  hand.run(12.0);
  assert_near(hand.tip().y_m, kStart.y_m, kDrift_m);
  assert_near(hand.strokes_m[kArm], kLineEnds_m, 1e-3);
  assert_int_equal(hand.want.cap.limit.kind, LimitKind::kStrokeEnd);
  assert_int_equal(hand.want.cap.limit.index, kArm);
  assert_true(hand.want.cap.factor < 0.01);
  const double end_m = hand.tip().x_m;
  hand.ask.lever_ratio[1] = -1.0;
  hand.run(2.0);
  assert_true(hand.tip().x_m < end_m - 0.3);
}

/// Where boom and arm cannot reach: stops, names a drive, and comes back.
TEST(beyond_reach_there_is_no_pose) {
  Hand hand(Task::kCoordinated);
  hand.ask.lever_ratio[1] = 1.0;
  hand.run(1.0);
  // As if the plan had got there.
  hand.state.tip.x_m = 30.0;
  hand.step();
  assert_true(hand.want.wanted_mps.isZero(0.0));
  assert_true(hand.want.speed.isZero(0.0));
  assert_int_equal(hand.want.cap.limit.kind, LimitKind::kStrokeEnd);
}

/// What stands in memory is no more than a full lever.
TEST(no_stored_speed_is_too_fast) {
  Hand hand(Task::kJog);
  hand.state.speed.setConstant(1e9);
  hand.step();
  assert_true(hand.want.wanted_mps.cwiseAbs().maxCoeff() < 0.32);
}

/// A design through the start, or so far under it, and rising outwards by `slope`.
FenceSet design(double under_m, double slope) {
  const Eigen::Vector2d& foot_m = profile().geometry.boom_foot_m;
  DesignPlane plane;
  plane.through_m << foot_m.x() + kStart.x_m, 0.0, foot_m.y() + kStart.y_m - under_m;
  plane.up = Eigen::Vector3d(-slope, 0.0, 1.0).normalized();
  FenceSet fences;
  fences.count = 1;
  fences.fence[0] = plane.fence();
  return fences;
}

/// With the task's window of 0.3 m.
struct Assisted : Hand {
  explicit Assisted(double under_m, double slope = 0.0) : Hand(Task::kAssist) {
    ask.design = assist_design(profile(), design(under_m, slope), 0.0, Eigen::Vector2d::Zero(), {});
    step();
  }
  [[nodiscard]] double height_m() const { return ask.design.now.height_m(tip()); }
};

/// Both ways, level and on a slope of 1:2, from 5 cm over it: onto it, never under it, as fast as
/// the arm alone would go, at the attitude that the bucket had.
TEST(the_edge_is_drawn_along_the_design) {
  for (const double slope : {0.0, 0.5}) {
    for (const double side : {1.0, -1.0}) {
      Assisted hand(0.05, slope);
      assert_int_equal(hand.want.assist, AssistState::kNear);
      hand.ask.lever_ratio[kArm] = side;
      double least_m = 1.0;
      for (int n = 0; n < 170; ++n) {
        hand.step();
        assert_int_equal(hand.want.assist, AssistState::kHolds);
        least_m = std::min(least_m, hand.height_m());
      }
      assert_near(std::min(0.0, least_m), 0.0, 2.5 * kDrift_m);  // It goes at 0.9 m/s.
      assert_near(hand.height_m(), 0.0, 0.01);
      assert_near(hand.want.wanted_mps[kArm], side * 0.232, 0.02);
      assert_near(hand.tip().attitude_rad, kStart.attitude_rad, kDrift_m);
      assert_true(side * (hand.tip().x_m - kStart.x_m) < -0.3);
    }
  }
}

/// Let go, it stands within half a period of the mode, or loses 0.2 m/s in a radian of it where it
/// is fast, evenly slowed, and nothing goes on; where the mode is not known, or slower, within 0.3
/// s.
TEST(an_arm_that_is_let_go_stops_all) {
  for (const auto& [mode_radps, half_s] :
       {std::pair(kPi / 0.15, 0.15), std::pair(kPi / 0.1, 0.1), std::pair(1.0, 0.3)}) {
    for (const double lever : {1.0, 0.2}) {
      Assisted hand(0.0);
      hand.ask.mode_radps = mode_radps;
      hand.ask.lever_ratio[kArm] = lever;
      hand.run(1.5);
      hand.ask.lever_ratio = {};
      const double from_mps = hand.want.speed.head<2>().norm();
      assert_true(lever < 1.0 ? from_mps > 0.1 && from_mps < 0.6 : from_mps > 0.7);
      const double stops_s = std::min(0.3, std::max(half_s, from_mps / (0.2 * mode_radps)));
      hand.run(0.5 * stops_s);
      assert_near(hand.want.speed.head<2>().norm(), 0.5 * from_mps, 0.12 * from_mps);
      hand.run(0.5 * stops_s + 0.02);
      assert_true(hand.want.wanted_mps.isZero(0.0));
    }
  }
  Assisted hand(0.0);
  hand.ask.lever_ratio[kArm] = 1.0;
  hand.run(1.5);
  hand.ask.lever_ratio = {};
  hand.run(0.4);
  assert_int_equal(hand.want.assist, AssistState::kNear);
  const Eigen::Vector3d stands_m = hand.strokes_m;
  hand.run(1.0);
  assert_true(hand.strokes_m == stands_m);
}

/// At once, and until the arm's lever has been at rest.
TEST(boom_up_and_swing_win) {
  for (const unsigned lever : {0U, 3U}) {
    Assisted hand(0.0);
    hand.ask.lever_ratio[kArm] = -1.0;
    hand.run(1.0);
    hand.ask.lever_ratio[lever] = 0.2;
    hand.step();
    assert_int_equal(hand.want.assist, AssistState::kLetGo);
    assert_true(hand.want.wanted_mps[kBoom] >= 0.0);
    hand.run(0.1);
    hand.ask.lever_ratio[lever] = 0.0;
    hand.step();
    assert_int_equal(hand.want.assist, AssistState::kLetGo);
    hand.ask.lever_ratio[kArm] = 0.0;
    hand.step();
    hand.ask.lever_ratio[kArm] = -1.0;
    hand.step();
    assert_int_equal(hand.want.assist, AssistState::kHolds);
  }
}

/// Boom down does not press the edge under the design, the bucket's lever turns the bucket on it.
TEST(other_levers_keep_to_the_design) {
  Assisted hand(0.0);
  hand.ask.lever_ratio = {-1.0, 0.5, 0.5, 0.0};
  hand.run(0.8);
  assert_int_equal(hand.want.assist, AssistState::kHolds);
  assert_near(hand.height_m(), 0.0, kDrift_m);
  assert_true(hand.tip().attitude_rad < kStart.attitude_rad - 0.1);
}

/// Beyond its window, without a design and in other tasks each drive goes by its own lever; once in
/// the window it stays in until a fifth beyond.
TEST(away_from_a_design_drives_are_jogged) {
  Assisted away(0.31);
  Assisted none(0.0);
  none.ask.design.present = false;
  Hand jog(Task::kJog);
  for (Hand* hand : {static_cast<Hand*>(&away), static_cast<Hand*>(&none), &jog}) {
    hand->ask.lever_ratio[kArm] = -0.5;
    hand->run(0.4);
    assert_true(hand->want.wanted_mps == jog.want.wanted_mps || hand != &jog);
    assert_near(hand->want.wanted_mps[kArm], -0.116, 1e-3);
    assert_near(hand->want.wanted_mps[kBoom], 0.0, 0.0);
  }
  assert_int_equal(away.want.assist, AssistState::kAway);
  assert_int_equal(none.want.assist, AssistState::kNone);
  Assisted kept(0.29);
  kept.ask.design.now.from_foot_m -= 0.05;
  kept.step();
  assert_int_equal(kept.want.assist, AssistState::kNear);
  kept.ask.design.now.from_foot_m -= 0.05;
  kept.step();
  assert_int_equal(kept.want.assist, AssistState::kAway);
}

/// No corner of the edge comes under a design that falls across the machine; what the mark has
/// shown too high and the offset count.
TEST(the_line_is_that_of_the_lower_corner) {
  ExcavatorProfile wide = profile();
  wide.assist.offset_m = 0.1;
  FenceSet fences = design(0.0, 0.0);
  fences.fence[0].normal = -Eigen::Vector3d(0.0, 0.1, 1.0).normalized();
  fences.fence[0].offset_m = 0.0;
  const double half_m = 0.5 * wide.geometry.body.bucket_width_m;
  const AssistLine line = assist_design(wide, fences, 0.0, {0.0, 0.02}, {}).at;
  assert_near(line.from_foot_m, 0.1 * half_m + 0.1 + 0.02 - wide.geometry.boom_foot_m.y(), 1e-12);
  // Turned to the left it rises outwards.
  const AssistLine left = assist_design(wide, fences, 0.5 * kPi, {0.0, 0.0}, {}).at;
  assert_near(left.along().y() / left.along().x(), -0.1, 1e-12);
  assert_false(assist_design(wide, FenceSet{}, 0.0, {0.0, 0.0}, {}).present);
}
