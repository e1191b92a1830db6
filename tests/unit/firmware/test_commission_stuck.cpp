// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "tests/unit/firmware/guarded_cylinder.hpp"

using namespace graben::test::guarded;

/// Any edge is open at seven tenths.
TEST(a_stroke_that_stands_at_a_large_duty_is_stuck) {
  for (const int side : {1, -1}) {
    Cylinder cylinder;
    assert_int_equal(cylinder.run(0.98, 0.7 * side, 0.0), Fault::kNone);
    assert_int_equal(cylinder.run(0.06, 0.7 * side, 0.0), Fault::kStrokeStuck);
    Cylinder slow;
    assert_int_equal(slow.run(2.0, 0.7 * side, 0.002 * side), Fault::kNone);
  }
}

/// A ramp to the last edge there is must be possible, as must a small duty for a while.
TEST(below_an_edge_it_may_stand_for_a_while, Cylinder ramp) {
  for (double duty = 0.0; duty < 0.65; duty += 0.08 * kPeriod_s) {
    assert_int_equal(ramp.step(duty, 0.0), Fault::kNone);
  }
  Cylinder small;
  assert_int_equal(small.run(20.0, 0.1, 0.0), Fault::kNone);
  Cylinder longer;
  assert_int_equal(longer.run(9.9, 0.3, 0.0), Fault::kNone);
  assert_int_equal(longer.run(0.3, 0.3, 0.0), Fault::kStrokeStuck);
}

/// Where it once moved with less, it has to again; each side has its own.
TEST(a_duty_that_has_moved_it_has_to_move_it_again) {
  for (const int side : {1, -1}) {
    Cylinder cylinder;
    assert_int_equal(cylinder.run(1.5, 0.3 * side, 0.05 * side), Fault::kNone);
    cylinder.run(2.0, 0.0, 0.0);
    Cylinder other = cylinder;
    rest_commission(cylinder.state);
    assert_int_equal(cylinder.run(0.99, 0.42 * side, 0.0), Fault::kNone);
    assert_int_equal(cylinder.run(0.06, 0.42 * side, 0.0), Fault::kStrokeStuck);
    assert_int_equal(other.run(2.0, -0.42 * side, 0.0), Fault::kNone);
    // A ramp that rises is steady too.
    Cylinder ramp;
    for (double duty = 0.3; duty < 0.4; duty += 0.08 * kPeriod_s) {
      assert_int_equal(ramp.step(duty * side, 0.05 * side), Fault::kNone);
    }
    ramp.run(2.0, 0.0, 0.0);
    assert_int_equal(ramp.run(1.1, 0.55 * side, 0.0), Fault::kStrokeStuck);
    // What rocks on its oil has not been moved.
    Cylinder rocks;
    for (int n = 0; n < 20; ++n) {
      rocks.run(0.1, 0.3 * side, 0.1 * side);
      assert_int_equal(rocks.run(0.1, 0.3 * side, -0.1 * side), Fault::kNone);
    }
    rocks.run(2.0, 0.0, 0.0);
    assert_int_equal(rocks.run(2.0, 0.42 * side, 0.0), Fault::kNone);
    // One that falls has been larger.
    Cylinder falling;
    for (double duty = 0.6; duty > 0.2; duty -= 0.2 * kPeriod_s) {
      assert_int_equal(falling.step(duty * side, 0.05 * side), Fault::kNone);
    }
    falling.run(2.0, 0.0, 0.0);
    assert_int_equal(falling.run(2.0, 0.42 * side, 0.0), Fault::kNone);
    // What moves it so soon after a reversal may be what came before it.
    Cylinder reversed;
    reversed.run(0.3, -0.3 * side, -0.05 * side);
    assert_int_equal(reversed.run(0.5, 0.3 * side, 0.05 * side), Fault::kNone);
    reversed.run(2.0, 0.0, 0.0);
    assert_int_equal(reversed.run(2.0, 0.42 * side, 0.0), Fault::kNone);
  }
}

/// Against a rock, at any duty.
TEST(a_cylinder_that_strains_is_stuck) {
  for (const int side : {1, -1}) {
    Cylinder cylinder;
    cylinder.ask.alone = false;
    double& fed_pa = side > 0 ? cylinder.seen.cap_pressure_pa : cylinder.seen.rod_pressure_pa;
    fed_pa = 0.79 * kRelief_pa;
    assert_int_equal(cylinder.run(2.0, 0.3 * side, 0.0), Fault::kNone);
    fed_pa = 0.81 * kRelief_pa;
    cylinder.row.watch.relief_pa = 0.0;
    assert_int_equal(cylinder.run(2.0, 0.3 * side, 0.0), Fault::kNone);
    cylinder.row.watch.relief_pa = kRelief_pa;
    assert_int_equal(cylinder.run(1.9, 0.3 * side, 0.0), Fault::kNone);
    assert_int_equal(cylinder.run(0.3, 0.3 * side, 0.0), Fault::kStrokeStuck);
    // Not known, nothing is said by it.
    Cylinder blind;
    blind.seen.load_known = false;
    fed_pa = 0.81 * kRelief_pa;
    assert_int_equal(blind.run(2.0, 0.3 * side, 0.0), Fault::kNone);
  }
}

/// Its sensor hangs, its oil flows.
TEST(pressures_that_have_changed_say_that_it_moves) {
  for (const bool alone : {true, false}) {
    Cylinder cylinder;
    cylinder.ask.alone = alone;
    cylinder.run(0.2, 0.2, 0.0);
    cylinder.seen.cap_pressure_pa += 8e6;
    cylinder.seen.rod_pressure_pa -= 1e6;
    assert_int_equal(cylinder.run(1.9, 0.2, 0.0), Fault::kNone);
    const Fault expected = alone ? Fault::kStrokeStuck : Fault::kNone;
    assert_int_equal(cylinder.run(0.5, 0.2, 0.0), expected);
    Cylinder little;
    little.run(0.2, 0.2, 0.0);
    little.seen.cap_pressure_pa += 1.45e6;
    little.seen.rod_pressure_pa += 1.45e6;
    assert_int_equal(little.run(5.0, 0.2, 0.0), Fault::kNone);
    // Between duties it may have any.
    Cylinder between;
    between.run(0.2, 0.2, 0.0);
    between.run(0.1, 0.0, 0.0);
    between.seen.cap_pressure_pa += 8e6;
    between.run(0.5, 0.0, 0.0);
    assert_int_equal(between.run(5.0, 0.2, 0.0), Fault::kNone);
  }
}

/// Where it has moved before, it takes more to say so, and nothing is held: a step goes at once.
TEST(pressures_of_a_side_that_has_moved) {
  for (const int side : {1, -1}) {
    Cylinder moved;
    assert_int_equal(moved.run(1.5, 0.3 * side, 0.05 * side), Fault::kNone);
    moved.run(2.0, 0.0, 0.0);
    Cylinder little = moved;
    little.run(0.2, 0.35 * side, 0.0);
    little.seen.cap_pressure_pa += 5e6;
    assert_int_equal(little.run(5.0, 0.35 * side, 0.0), Fault::kNone);
    moved.run(0.2, 0.2 * side, 0.0);
    moved.seen.cap_pressure_pa += 8e6;
    assert_int_equal(moved.run(0.3, 0.2 * side, 0.0), Fault::kNone);
    assert_int_equal(moved.run(2.7, 0.35 * side, 0.0), Fault::kNone);
    assert_near(moved.result.duty_ratio, 0.35 * side, 0.0);
    assert_int_equal(moved.run(0.8, 0.35 * side, 0.0), Fault::kStrokeStuck);
  }
}

/// Pressures that change tell of an edge that opens: no more is tried before something moves, then
/// little by little.
TEST(what_may_move_unseen_is_held_back) {
  for (const int side : {1, -1}) {
    Cylinder cylinder;
    cylinder.run(0.2, 0.2 * side, 0.0);
    cylinder.seen.cap_pressure_pa += 8e6 * side;
    cylinder.run(0.2, 0.2 * side, 0.0);
    cylinder.run(0.5, 0.4 * side, 0.0);
    assert_near(cylinder.result.duty_ratio, 0.2 * side, 0.0);
    assert_false(cylinder.result.held);
    cylinder.run(0.9, 0.4 * side, 0.0);
    assert_in_range(std::lround(1e3 * side * cylinder.result.duty_ratio), 205, 225);
    // Less may be asked for at any time, and the other side too.
    Cylinder other = cylinder;
    other.step(0.1 * side, 0.0);
    assert_near(other.result.duty_ratio, 0.1 * side, 0.0);
    other.step(0.0, 0.0);
    other.step(-0.4 * side, 0.0);
    assert_near(other.result.duty_ratio, -0.4 * side, 0.0);
    // Once it moves, or its pressures are as they were, it is free.
    Cylinder calm = cylinder;
    calm.seen.cap_pressure_pa -= 8e6 * side;
    calm.run(0.3, 0.4 * side, 0.0);
    assert_near(calm.result.duty_ratio, 0.4 * side, 0.0);
    cylinder.step(0.4 * side, 0.1 * side);
    assert_near(cylinder.result.duty_ratio, 0.4 * side, 0.0);
  }
}
