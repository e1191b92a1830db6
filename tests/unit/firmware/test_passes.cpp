// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/travel/passes.hpp"
#include "tests/unit/cmocka_cpp.hpp"

constexpr double kPeriod_s = 0.01;

/// Level, 10 m long.
GradeDesign design() {
  GradeDesign grade;
  grade.point[0] = {0.0, -0.3};
  grade.point[1] = {10.0, -0.3};
  grade.count = 2;
  grade.tolerance_m = 0.02;
  grade.pass_depth_m = 0.2;
  grade.passes_most = 4;
  return grade;
}

/// The edge goes from one place to the other, as far off the design, pushing and lifted so.
PassState goes(PassState state, double from_m, double to_m, double error_m, double push = 0.0,
               double lift_m = 0.0) {
  const double step_m = from_m < to_m ? 0.01 : -0.01;
  for (int n = 0; n <= static_cast<int>((to_m - from_m) / step_m + 0.5); ++n) {
    state =
        next_pass(design(), state, {from_m + n * step_m, error_m, 1.0, push, lift_m}, kPeriod_s);
  }
  return state;
}

PassState stands(PassState state, double at_m, int cycles) {
  for (int n = 0; n < cycles; ++n) {
    state = next_pass(design(), state, {at_m, 0.0, 0.0, 0.0, 0.0}, kPeriod_s);
  }
  return state;
}

TEST(what_is_met_in_one_pass_is_done_with_it) {
  const PassState on = goes({}, -1.0, 9.9, 0.024);
  assert_false(on.finished || on.left);
  const PassState done = goes(on, 9.9, 10.1, 0.0);
  assert_true(done.finished);
  assert_int_equal(done.pass, 1);
  assert_int_equal(static_cast<int>(done.phase), static_cast<int>(PassPhase::kCut));
}

/// Stop with the blade rising, back to a run-up before the first place, halt, next pass.
TEST(what_is_left_is_gone_back_for) {
  PassState state = goes({}, -1.0, 4.0, 0.0);
  state = goes(state, 4.0, 6.0, 0.1);
  state = goes(state, 6.0, 10.01, 0.0);
  assert_int_equal(static_cast<int>(state.phase), static_cast<int>(PassPhase::kStop));
  assert_near(state.from_m, 4.0, 0.05);
  assert_near(pass_speed_mps(state, {10.0, 0.0, 1.0, 0.0, 0.0}, 1.6, 1.0), 0.0, 0.0);
  state = stands(state, 10.2, 200);
  assert_int_equal(static_cast<int>(state.phase), static_cast<int>(PassPhase::kReturn));
  assert_near(state.clear_m, 0.25, 1e-9);
  assert_near(pass_speed_mps(state, {9.0, 0.0, -1.0, 0.0, 0.0}, 1.6, 1.0), -1.0, 1e-12);
  assert_near(pass_speed_mps(state, {9.0, 0.0, -1.0, 0.0, 0.0}, 0.5, 1.0), -0.5, 1e-12);
  assert_true(pass_speed_mps(state, {2.85, 0.0, -1.0, 0.0, 0.0}, 1.6, 1.0) > -0.5);
  state = goes(state, 10.2, 2.7, 0.25);
  assert_int_equal(static_cast<int>(state.phase), static_cast<int>(PassPhase::kTurn));
  state = stands(state, 2.7, 2);
  assert_int_equal(static_cast<int>(state.phase), static_cast<int>(PassPhase::kCut));
  assert_int_equal(state.pass, 2);
  assert_false(state.left);
}

/// Each pass leaves less than the one before.
PassState next(PassState state, double push, double lift_m) {
  state = goes(state, 0.0, 10.01, 0.1 / state.pass, push, lift_m);
  state = stands(state, 10.2, 200);
  state = goes(state, 10.2, -1.3, 0.25);
  return stands(state, -1.3, 200);
}

/// By 0.9 of its force over what the pass before took, and no more than 1.6 times as deep.
TEST(a_pass_with_force_to_spare_makes_the_next_deeper) {
  assert_near(pass_floor_m(design(), {}), -0.2, 1e-12);
  assert_near(pass_floor_m(design(), next({}, 0.9, 0.0)), -0.4, 1e-12);
  assert_near(pass_floor_m(design(), next({}, 0.75, 0.0)), -0.44, 1e-12);
  assert_near(pass_floor_m(design(), next({}, 0.3, 0.0)), -0.52, 1e-12);
  // A push above what is allowed that lifted nothing is one stone.
  assert_near(pass_floor_m(design(), next({}, 1.3, 0.0)), -0.4, 1e-12);
}

/// A lift of 50 mm all the way is half of 0.2 m: 0.7 of the depth, of which half is taken again.
TEST(a_pass_that_was_lifted_makes_the_next_less_deep) {
  const PassState second = next({}, 1.1, 0.05);
  assert_near(second.step_m, 0.14, 1e-12);
  assert_near(pass_floor_m(design(), second), -0.27, 1e-3);
  // It gets on however hard it is.
  PassState hard;
  for (int pass = 0; pass < 2; ++pass) {
    const double floor_m = pass_floor_m(design(), hard);
    hard = next(hard, 1.5, 0.2);
    assert_true(pass_floor_m(design(), hard) <= floor_m - 0.03 + 1e-12);
  }
}

/// The blade on its way down at the beginning leaves nothing, however late it is, before it has
/// come down or to what is to be cut: or each pass would begin before the one before.
TEST(a_blade_that_comes_down_leaves_nothing) {
  PassState state = goes({}, -1.0, 4.0, 0.0);
  state = goes(goes(state, 4.0, 6.0, 0.1), 6.0, 10.01, 0.0);
  state = stands(goes(stands(state, 10.2, 200), 10.2, 2.7, 0.25), 2.7, 2);
  assert_int_equal(state.pass, 2);
  assert_false(state.down);
  state.clear_m = 0.0;
  const PassState late = goes(state, 2.8, 3.9, 0.2);
  assert_false(late.left || late.down);
  const PassState never = goes(late, 3.9, 5.0, 0.2);
  assert_true(never.left && never.down);
  assert_near(never.from_m, 4.04, 0.02);
  // What the pass before left good stays so if the blade comes down to it and bounces.
  const PassState bounced = goes(goes(state, 2.8, 3.0, 0.01), 3.01, 3.9, 0.2);
  assert_true(bounced.down);
  assert_false(bounced.left);
  assert_near(goes(bounced, 3.91, 5.0, 0.2).from_m, state.due_m, 0.011);
}

/// 10 mm of noise on 18 mm that stay.
TEST(noise_is_no_ground_that_is_left, PassState state) {
  for (int n = 0; n < 1000; ++n) {
    const double error_m = 0.018 + (n % 2 == 0 ? 0.01 : -0.01);
    state = next_pass(design(), state, {0.01 * n, error_m, 1.0, 0.0, 0.0}, kPeriod_s);
  }
  assert_false(state.left);
}

/// A place where the edge can't go lower is told, and not gone back for again and again.
TEST(two_passes_that_lower_nothing_are_the_last) {
  PassState state = goes(goes({}, 0.0, 5.0, 0.1), 5.01, 10.01, 0.0);
  state = stands(goes(stands(state, 10.2, 200), 10.2, -1.3, 0.25), -1.3, 2);
  assert_int_equal(state.pass, 2);
  PassState again = goes(goes(state, 0.0, 5.0, 0.1), 5.01, 10.01, 0.0);
  assert_true(again.left && !again.finished);
  again = stands(goes(stands(again, 10.2, 200), 10.2, -1.3, 0.25), -1.3, 2);
  const PassState same = goes(goes(again, 0.0, 5.0, 0.1), 5.01, 10.01, 0.0);
  assert_true(same.finished && same.left);
  const PassState lower = goes(goes(again, 0.0, 5.0, 0.08), 5.01, 10.01, 0.0);
  assert_true(lower.left && !lower.finished);
  assert_int_equal(lower.vain, 0);
}

TEST(there_are_no_more_than_are_allowed, PassState state) {
  for (int pass = 1; pass < 4; ++pass) {
    state = goes(state, 0.0, 10.01, 0.1 / pass);
    state = stands(state, 10.2, 200);
    state = goes(state, 10.2, -1.3, 0.25);
    state = stands(state, -1.3, 200);
  }
  assert_int_equal(state.pass, 4);
  state = goes(state, 0.0, 10.01, 0.03);
  assert_true(state.finished && state.left);
  assert_int_equal(static_cast<int>(state.phase), static_cast<int>(PassPhase::kCut));
}
