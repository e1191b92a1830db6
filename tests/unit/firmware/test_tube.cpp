// SPDX-License-Identifier: Apache-2.0
// A tube around what is followed.

#include "firmware/safety/tube.hpp"

#include <cmath>
#include <limits>

#include "tests/unit/cmocka_cpp.hpp"

constexpr double kTube_m = 0.25;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

Fault told(const TubeState& state) {
  CommonValid valid;
  tell_tube(state, valid);
  assert_int_equal(valid.faults.has(Fault::kPathLeft), valid.fault == Fault::kPathLeft);
  return valid.fault;
}

Fault after(TubeState& state, double error_m, bool active = true) {
  next_tube(active, error_m, kTube_m, state);
  return told(state);
}

TEST(it_may_begin_anywhere_and_come_near, TubeState state) {
  assert_int_equal(told(state), Fault::kNone);
  for (const double error_m : {4.0, 4.25, 2.0, 2.25, 0.0, 0.25}) {
    assert_int_equal(after(state, error_m), Fault::kNone);
  }
  assert_int_equal(after(state, std::nextafter(0.25, 1.0)), Fault::kPathLeft);
  assert_int_equal(after(state, 0.25), Fault::kNone);
}

TEST(away_from_where_it_came_to_is_outside, TubeState state) {
  static_cast<void>(after(state, 2.0));
  assert_int_equal(after(state, 2.2501), Fault::kPathLeft);
  assert_int_equal(after(state, kNone), Fault::kPathLeft);
  TubeState fresh;
  assert_int_equal(after(fresh, std::numeric_limits<double>::infinity()), Fault::kPathLeft);
}

TEST(the_next_task_begins_newly, TubeState state) {
  static_cast<void>(after(state, 0.0));
  static_cast<void>(after(state, 1.0));
  assert_int_equal(after(state, 1.0, false), Fault::kNone);
  assert_int_equal(after(state, 1.0), Fault::kNone);
}

Fault above(TubeState& state, double error_m, bool active = true) {
  next_tube_above(active, error_m, kTube_m, state);
  return told(state);
}

TEST(below_a_surface_is_never_far, TubeState state) {
  assert_int_equal(above(state, -0.25), Fault::kNone);
  assert_int_equal(above(state, std::nextafter(-0.25, -1.0)), Fault::kPathLeft);
  assert_int_equal(above(state, -1.0, false), Fault::kNone);
  // High above at the beginning, until it has come down.
  assert_int_equal(above(state, 1.0), Fault::kNone);
  assert_int_equal(above(state, -0.1), Fault::kNone);
  assert_int_equal(above(state, 0.25), Fault::kNone);
  assert_int_equal(above(state, 0.251), Fault::kPathLeft);
  assert_int_equal(above(state, kNone), Fault::kPathLeft);
}
