// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/hand/hand_motion.hpp"

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/excavator_steps.hpp"
#include "tests/unit/firmware/fixture.hpp"

constexpr double kPeriod_s = 0.01;
constexpr TipPose kStart = {5.0, -0.5, 1.3};
constexpr double kDrift_m = 2e-3;  ///< Of steps of 10 ms that nothing corrects.

const ExcavatorProfile& profile() { return test::excavator().profile; }

/// The machine does at once what is wanted, as far as `followed` lets it.
struct Hand {
  ExcavatorBank bank = excavator_bank(profile());
  ExcavatorKinematics kinematics{profile().geometry};
  ExcavatorServo servo;
  HandState state;
  HandAsk ask;
  HandWant want;
  Eigen::Vector3d strokes_m;
  double followed = 1.0;

  explicit Hand(Task task, const TipPose& tip = kStart) {
    ask.task = task;
    ask.speed_override_ratio = 1.0;
    strokes_m = kinematics.strokes_from_pose(tip).strokes_m;
    step();
  }
  [[nodiscard]] TipPose tip() const { return kinematics.state(strokes_m).tip; }
  void step() {
    for (int i = 0; i < kAxisCount; ++i) {
      servo.drive[static_cast<unsigned>(i)].stroke_m = strokes_m[i];
    }
    want = want_by_hand(profile(), bank.rows(), kinematics, kinematics.state(strokes_m), servo, ask,
                        state, kPeriod_s);
    const Eigen::Vector3d wanted_mps = want.wanted_mps.head<kAxisCount>();
    strokes_m += kPeriod_s * followed * wanted_mps;
    state = next_by_hand(profile().line, want, ask, state, followed, kPeriod_s);
  }
  void run(double time_s) {
    for (double at_s = 0.0; at_s < time_s; at_s += kPeriod_s) {
      step();
    }
  }
};

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
