// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/blade.hpp"
#include "firmware/dozer/blade_control.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/dozer_fixture.hpp"

constexpr double kPeriod_s = 0.01;

const DozerProfile& profile() { return test::dozer().profile; }

BladeSituation driving(double speed_mps, double height_m) {
  BladeSituation now;
  now.body.position_m = {0.0, 0.0, height_m};
  now.body_velocity[0] = speed_mps;
  return now;
}

BladeCommand command(const GradeDesign& design, const BladeSituation& now,
                     const BladeSituation& then, BladeState last = {}) {
  return control_blade(profile(), dozer_bank(profile()).row[0], BladeKinematics(profile().blade),
                       GradeProfile(design), last, now, then,
                       available_flow_m3ps(profile().implement, 157.08), kPeriod_s);
}

BladeCommand command(const GradeDesign& design, const BladeSituation& now, BladeState last = {}) {
  return command(design, now, now, last);
}

TEST(on_the_grade_it_rests) {
  const BladeCommand rest = command(test::level(0.0), driving(1.0, 0.0));
  assert_near(rest.velocity_mps, 0.0, 1e-12);
  assert_near(rest.error_m, 0.0, 1e-12);
}

/// Too high: extension, which lowers; as fast as the gain says.
TEST(an_error_is_taken_back) {
  const BladeCommand high = command(test::level(-0.01), driving(1.0, 0.0));
  assert_near(high.error_m, 0.01, 1e-12);
  assert_true(high.velocity_mps > 0.0);
  const BladeKinematics blade(profile().blade);
  const double edge_mps =
      high.velocity_mps / blade.stroke_rate_mprad(0.0) * blade.edge_rate_mprad(0.0).y();
  assert_near(edge_mps, -profile().control.blade_gain_ps * 0.01, 1e-9);
  assert_near(command(test::level(0.01), driving(1.0, 0.0)).velocity_mps, -high.velocity_mps, 1e-9);
}

/// What is too high within half the tolerance goes down a tenth of its way, and is not integrated;
/// what is too deep, or far too high, does not wait.
TEST(it_comes_down_over_some_way) {
  const BladeKinematics blade(profile().blade);
  const double gain_ps = profile().control.blade_gain_ps;
  const double half_m = 0.5 * profile().grade.tolerance_m;
  const auto edge_mps = [&](double above_m, double speed_mps) {
    return command(test::level(-above_m), driving(speed_mps, 0.0)).velocity_mps /
           blade.stroke_rate_mprad(0.0) * blade.edge_rate_mprad(0.0).y();
  };
  assert_near(edge_mps(0.5 * half_m, 0.2), -0.02, 1e-9);
  assert_near(edge_mps(0.5 * half_m, 0.0), 0.0, 1e-12);
  assert_near(edge_mps(0.001, 0.2), -gain_ps * 0.001, 1e-9);
  assert_near(edge_mps(half_m + 0.002, 0.2), -0.02 - gain_ps * 0.002, 1e-9);
  assert_near(edge_mps(-0.5 * half_m, 0.0), gain_ps * 0.5 * half_m, 1e-9);
  const BladeCommand sinking = command(test::level(-0.5 * half_m), driving(0.2, 0.0));
  assert_true(sinking.sinks);
  assert_near(sinking.state.integral_mps, 0.0, 0.0);
  assert_false(command(test::level(-0.001), driving(0.2, 0.0)).sinks);
}

/// Feed-forward: with it the edge keeps its height over the design whatever the body does.
TEST(the_bodys_motion_is_made_up_for) {
  BladeSituation now = driving(0.8, 0.0);
  now.body_velocity[2] = 0.05;
  now.body_velocity[4] = -0.1;
  const BladeKinematics blade(profile().blade);
  const BladeCommand made_up = command(test::level(0.0), now);
  const double joint_radps = made_up.feed_forward_mps / blade.stroke_rate_mprad(0.0);
  const Vector6d edge = body_jacobian(blade, now.body, 0.0) * now.body_velocity +
                        blade_jacobian(blade, now.body, 0.0) * joint_radps;
  assert_near(edge[2], 0.0, 1e-12);
}

/// The design is read, and the body's motion taken, as they will be when the cylinders answer.
TEST(it_is_asked_for_what_will_be) {
  const BladeKinematics blade(profile().blade);
  const GradeDesign bent = test::bend(-0.3, 0.1);
  BladeSituation now = driving(1.0, 0.0);
  // The bend begins a centimetre further on than it is now.
  now.body.position_m.x() = 9.9 - 0.01 - blade.edge_m(0.0).x();
  BladeSituation then = now;
  then.body.position_m.x() += 0.05;
  const BladeCommand ahead = command(bent, now, then);
  assert_near(ahead.feed_forward_mps, 0.0, 1e-12);
  assert_true(ahead.velocity_mps > 0.001);
}

/// What is asked for already, and has only to arrive, is not asked for again; what is measured now
/// is integrated all the same.
TEST(what_is_under_way_is_not_asked_for_twice) {
  const BladeKinematics blade(profile().blade);
  const BladeSituation now = driving(1.0, 0.0);
  BladeSituation then = now;
  repeat(20, [&] { then.angle_rad -= (blade.edge_m(then.angle_rad).y() + 0.01) / 1.6; });
  const BladeCommand waits = command(test::level(-0.01), now, then);
  assert_near(waits.velocity_mps, 0.0, 1e-6);
  assert_near(waits.error_m, 0.01, 1e-12);
  assert_true(waits.state.integral_mps > 0.0);
}

/// On its lift it is where it is meant to be, and goes along with it.
TEST(a_lift_is_followed) {
  BladeSituation lifted = driving(1.0, 0.01);
  lifted.lift = {0.01, 0.0};
  const BladeCommand there = command(test::level(0.0), lifted);
  assert_near(there.velocity_mps, 0.0, 1e-12);
  assert_near(there.off_m, 0.0, 1e-12);
  assert_near(there.error_m, 0.01, 1e-12);
  lifted.lift.slope = 0.05;
  const BladeKinematics blade(profile().blade);
  const BladeCommand rising = command(test::level(0.0), lifted);
  const double edge_mps =
      rising.velocity_mps / blade.stroke_rate_mprad(0.0) * blade.edge_rate_mprad(0.0).y();
  assert_near(edge_mps, 0.05, 1e-9);
}

TEST(what_stays_is_integrated_up_to_its_bound, BladeState state) {
  repeat(50, [&] { state = command(test::level(-0.005), driving(2.0, 0.0), state).state; });
  assert_near(state.integral_mps, profile().control.blade_integral_ps2 * 0.005 * 0.5, 1e-9);
  repeat(5000, [&] { state = command(test::level(-0.005), driving(2.0, 0.0), state).state; });
  assert_near(state.integral_mps, profile().control.blade_integral_most_mps, 1e-9);
}

/// While the pump can't feed what is asked for, nothing winds up.
TEST(out_of_flow_the_integral_stands_still) {
  const BladeState state = command(test::level(-0.3), driving(0.0, 0.0)).state;
  assert_near(state.integral_mps, 0.0, 0.0);
}

TEST(towards_its_ends_it_slows_down) {
  const BladeKinematics blade(profile().blade);
  BladeSituation now = driving(0.0, 0.0);
  double last_mps = 1e9;
  for (const double left_m : {0.02, 0.01, 0.005, 0.0}) {
    now.angle_rad = blade.angle_rad(blade.stroke_max_m() - left_m);
    const BladeCommand low = command(test::level(-2.0), now);
    assert_true(low.at_end);
    assert_true(low.velocity_mps >= 0.0 && low.velocity_mps < last_mps);
    last_mps = low.velocity_mps;
  }
  assert_near(last_mps, 0.0, 1e-9);
  now.angle_rad = blade.angle_max_rad();
  assert_near(command(test::level(3.0), now).velocity_mps, 0.0, 1e-9);
  assert_true(command(test::level(-3.0), now).velocity_mps > 0.0);
}
