// SPDX-License-Identifier: Apache-2.0
#include "tests/unit/firmware/guarded_cylinder.hpp"

using namespace graben::test::guarded;

TEST(a_duty_in_its_window_is_sent) {
  for (const double duty : {0.3, -0.3, 1.0, -1.0}) {
    Cylinder cylinder;
    cylinder.step(duty, 0.0);
    assert_near(cylinder.result.duty_ratio, duty, 0.0);
    assert_false(cylinder.result.held);
  }
}

/// One that the cylinder does not have is none.
TEST(without_a_window_nothing_is_sent) {
  constexpr double beyond = 0.002;
  for (const StrokeWindow& window :
       {StrokeWindow{}, StrokeWindow{0.2, 0.8, 0.0}, StrokeWindow{0.5, 0.5, 0.5},
        StrokeWindow{-beyond, 0.8, 0.5}, StrokeWindow{0.2, kStroke_m + beyond, 0.5}}) {
    Cylinder cylinder;
    cylinder.ask.window = window;
    for (const double duty : {0.3, -0.3}) {
      assert_int_equal(cylinder.step(duty, 0.0), Fault::kNone);
      assert_near(cylinder.result.duty_ratio, 0.0, 0.0);
      assert_true(cylinder.result.held);
    }
  }
  Cylinder none(0.5, StrokeWindow{});
  assert_int_equal(none.step(0.3, 0.0), Fault::kNone);
  assert_true(none.result.held);
  Cylinder whole(0.5, kWhole);
  whole.step(0.3, 0.0);
  assert_near(whole.result.duty_ratio, 0.3, 0.0);
}

TEST(a_window_has_its_bounds) {
  const DriveRow row = excavator_bank(test::plain_machine()).row[2];
  assert_true(is_window(row, kWhole));
  assert_true(is_window(row, {-0.0009, kStroke_m + 0.0009, 0.5}));
  assert_true(is_window(row, {0.5, 0.5001, 1e-6}));
  for (const StrokeWindow& window :
       {StrokeWindow{-0.0011, kStroke_m, 0.5}, StrokeWindow{0.0, kStroke_m + 0.0011, 0.5},
        StrokeWindow{0.5, 0.5, 0.5}, StrokeWindow{0.6, 0.5, 0.5}, StrokeWindow{0.0, 1.0, -0.5},
        StrokeWindow{0.0, 1.0, 0.0}}) {
    assert_false(is_window(row, window));
  }
}

/// One of its ends is the cylinder's, the other one's own.
TEST(each_end_of_a_window_is_its_own) {
  for (const int side : {1, -1}) {
    const StrokeWindow window =
        side > 0 ? StrokeWindow{0.2, kStroke_m, 0.5} : StrokeWindow{0.0, 0.8, 0.5};
    Cylinder touches(side > 0 ? kStroke_m - 0.005 : 0.005, window);
    touches.step(0.4 * side, 0.0);
    assert_near(touches.result.duty_ratio, 0.4 * side, 0.0);
    Cylinder ends(side > 0 ? 0.2 : 0.8, window);
    ends.step(-0.4 * side, 0.0);
    assert_near(ends.result.duty_ratio, 0.0, 0.0);
    // Far from the end that it may touch it has to move.
    Cylinder middle(0.5, window);
    assert_int_equal(middle.run(1.1, 0.7 * side, 0.0), Fault::kStrokeStuck);
  }
}

/// It is held back where its speed will have taken it out before it can be stopped, and no sooner;
/// and stays so until something else is asked for. Back it may go at once.
TEST(it_is_stopped_before_the_edge) {
  for (const int side : {1, -1}) {
    Cylinder cylinder;
    constexpr double speed_mps = 0.2;
    while (!cylinder.result.held) {
      assert_int_equal(cylinder.step(0.4 * side, speed_mps * side), Fault::kNone);
      assert_true(cylinder.moved_m * side < 0.3);
    }
    const double left_m = 0.3 - cylinder.moved_m * side;
    assert_true(left_m <= speed_mps * kGuardStops_s + 1e-9);
    assert_true(left_m > speed_mps * kGuardStops_s - 0.01);
    for (int n = 0; n < 30; ++n) {
      assert_int_equal(cylinder.step(0.4 * side, 0.0), Fault::kNone);
      assert_near(cylinder.result.duty_ratio, 0.0, 0.0);
    }
    cylinder.step(-0.4 * side, 0.0);
    assert_near(cylinder.result.duty_ratio, -0.4 * side, 0.0);
    cylinder.step(0.4 * side, 0.0);
    assert_near(cylinder.result.duty_ratio, 0.4 * side, 0.0);
  }
}

/// At rest at the edge, and beyond it: back only.
TEST(outside_only_back_is_free) {
  for (const double stroke_m : {0.8, 0.83}) {
    Cylinder cylinder(stroke_m);
    cylinder.step(0.4, 0.0);
    assert_near(cylinder.result.duty_ratio, 0.0, 0.0);
    cylinder.step(-0.4, 0.0);
    assert_near(cylinder.result.duty_ratio, -0.4, 0.0);
  }
}

TEST(farther_outside_is_a_fault) {
  for (const int side : {1, -1}) {
    Cylinder cylinder(0.5 + side * (0.3 + kGuardOutside_m - 0.001));
    assert_int_equal(cylinder.step(0.0, 0.0), Fault::kNone);
    assert_int_equal(cylinder.step(0.0, side * 0.2), Fault::kCommissionBound);
    // Where none is confirmed, it is none of the window's business.
    cylinder.ask.window = {};
    assert_int_equal(cylinder.step(0.0, 0.0), Fault::kNone);
  }
}

/// One that begins there may come back, and then has to stay.
TEST(who_begins_outside_may_come_in) {
  for (const int side : {1, -1}) {
    Cylinder cylinder(0.5 + side * 0.45);
    assert_int_equal(cylinder.step(0.4 * side, 0.0), Fault::kNone);
    assert_near(cylinder.result.duty_ratio, 0.0, 0.0);
    assert_int_equal(cylinder.run(1.1, -0.4 * side, -0.1 * side), Fault::kNone);
    cylinder.run(2.0, 0.0, 0.0);
    assert_int_equal(cylinder.run(2.0, 0.2 * side, 0.1 * side), Fault::kCommissionBound);
  }
}

TEST(faster_than_confirmed_is_a_fault) {
  for (const int side : {1, -1}) {
    Cylinder slower;
    assert_int_equal(slower.run(0.5, 0.4 * side, 0.49 * side), Fault::kNone);
    Cylinder faster;
    assert_int_equal(faster.run(0.5, 0.4 * side, 0.55 * side), Fault::kCommissionBound);
  }
}

/// From rest every step against the duty counts, whatever the machine's dead time.
TEST(a_reversed_valve_is_stopped_within_50_mm) {
  for (const int side : {1, -1}) {
    for (const double speed_mps : {0.003, 0.008, 0.015, 0.05, 0.3}) {
      Cylinder cylinder;
      assert_int_equal(cylinder.run(20.0, 0.15 * side, -speed_mps * side), Fault::kWrongDirection);
      assert_true(std::abs(cylinder.moved_m) > 0.03);
      assert_true(std::abs(cylinder.moved_m) < 0.05);
    }
  }
}

/// A load that sinks while the spool is at its edge.
TEST(what_creeps_is_no_wrong_direction, Cylinder cylinder) {
  assert_int_equal(cylinder.run(2.0, 0.15, -0.0055), Fault::kNone);
  Cylinder still;
  assert_int_equal(still.run(10.0, 0.0, -0.0055), Fault::kNone);
}

/// After a reversal a slow machine goes on for as long as its dead time and lags.
TEST(a_drive_may_coast_against_a_new_duty) {
  Cylinder cylinder(0.3);
  assert_int_equal(cylinder.run(0.8, 0.4, 0.2), Fault::kNone);
  assert_int_equal(cylinder.run(0.55, -0.4, 0.2), Fault::kNone);
  cylinder.moved_m = 0.0;
  assert_int_equal(cylinder.run(1.0, -0.4, 0.2), Fault::kWrongDirection);
  assert_true(cylinder.moved_m < 0.05);
}

/// Also while it comes to rest; then it has to stand.
TEST(a_drive_may_coast_without_a_duty) {
  Cylinder cylinder(0.3);
  assert_int_equal(cylinder.run(0.8, 0.4, 0.1), Fault::kNone);
  assert_int_equal(cylinder.run(0.95, 0.0, 0.1), Fault::kNone);
  cylinder.moved_m = 0.0;
  assert_int_equal(cylinder.run(1.0, 0.0, 0.1), Fault::kUncommandedMotion);
  assert_true(cylinder.moved_m < 0.05);
}

/// While another is: however slowly, its sensor may be that one's.
TEST(a_drive_beside_a_driven_one_stands) {
  for (const int side : {1, -1}) {
    Cylinder cylinder;
    cylinder.ask.alone = false;
    assert_int_equal(cylinder.run(20.0, 0.0, 0.005 * side), Fault::kUncommandedMotion);
    assert_true(std::abs(cylinder.moved_m) < 0.05);
    // One that was driven itself may come to rest first.
    Cylinder coasts(side > 0 ? 0.3 : 0.7);
    coasts.ask.alone = false;
    assert_int_equal(coasts.run(0.8, 0.4 * side, 0.1 * side), Fault::kNone);
    assert_int_equal(coasts.run(0.95, 0.0, 0.1 * side), Fault::kNone);
    // Between duties it is forgotten.
    Cylinder by_turns;
    for (int n = 0; n < 4; ++n) {
      by_turns.ask.alone = n % 2 == 0;
      assert_int_equal(by_turns.run(5.0, 0.0, 0.005 * side), Fault::kNone);
    }
  }
}

TEST(a_drive_that_is_not_driven_stands) {
  for (const int side : {1, -1}) {
    Cylinder cylinder;
    assert_int_equal(cylinder.run(1.0, 0.0, 0.1 * side), Fault::kUncommandedMotion);
    assert_true(std::abs(cylinder.moved_m) < 0.04);
  }
}

/// An end that the window reaches may be met slowly, and pushed against for a second.
TEST(an_end_may_be_touched) {
  for (const int side : {1, -1}) {
    Cylinder cylinder(side > 0 ? 0.95 : 0.05, kWhole);
    assert_int_equal(cylinder.run(2.0, 0.3 * side, 0.022 * side), Fault::kNone);
    assert_false(cylinder.result.held);
    cylinder.seen.cap_pressure_pa = kRelief_pa;
    cylinder.seen.rod_pressure_pa = kRelief_pa;
    assert_int_equal(cylinder.run(0.9, 0.7 * side, 0.0), Fault::kNone);
    assert_near(cylinder.result.duty_ratio, 0.7 * side, 0.0);
    assert_int_equal(cylinder.run(0.2, 0.7 * side, 0.0), Fault::kNone);
    assert_near(cylinder.result.duty_ratio, 0.0, 0.0);
    assert_int_equal(cylinder.run(2.0, 0.7 * side, 0.0), Fault::kNone);
    assert_near(cylinder.result.duty_ratio, 0.0, 0.0);
    // Shown farther than it is, it goes beyond.
    Cylinder beyond(side > 0 ? kStroke_m - 0.002 : 0.002, kWhole);
    beyond.run(0.3, 0.3 * side, 0.01 * side);
    assert_near(beyond.result.duty_ratio, 0.3 * side, 0.0);
  }
}

TEST(an_end_is_not_met_fast) {
  for (const int side : {1, -1}) {
    Cylinder cylinder(0.5, kWhole);
    while (!cylinder.result.held) {
      assert_int_equal(cylinder.step(0.5 * side, 0.2 * side), Fault::kNone);
      assert_true(std::abs(cylinder.moved_m) < 0.5);
    }
    const double left_m = 0.5 - std::abs(cylinder.moved_m);
    assert_near(left_m, (0.2 - kGuardTouch_mps) * kGuardStops_s, 0.005);
  }
}
