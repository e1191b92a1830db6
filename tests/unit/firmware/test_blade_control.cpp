#include "firmware/dozer/blade.hpp"
#include "firmware/dozer/blade_control.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/dozer_fixture.hpp"

namespace {

using namespace graben;

constexpr double kPeriod_s = 0.01;

const DozerProfile& profile() { return test::dozer().profile; }

BladeSituation driving(double speed_mps, double height_m) {
  BladeSituation now;
  now.body.position_m = {0.0, 0.0, height_m};
  now.body_velocity[0] = speed_mps;
  now.available_flow_m3ps = available_flow_m3ps(profile().implement, 157.08);
  return now;
}

BladeCommand command(const GradeDesign& design, const BladeSituation& now, BladeState last = {}) {
  return control_blade(profile(), dozer_bank(profile()).row[0], BladeKinematics(profile().blade),
                       GradeProfile(design), last, now, kPeriod_s);
}

void on_the_grade_it_rests(void**) {
  const BladeCommand rest = command(test::level(0.0), driving(1.0, 0.0));
  assert_near(rest.velocity_mps, 0.0, 1e-12);
  assert_near(rest.error_m, 0.0, 1e-12);
}

/// Too high: extension, which lowers; as fast as the gain says.
void an_error_is_taken_back(void**) {
  const BladeCommand high = command(test::level(-0.01), driving(0.0, 0.0));
  assert_near(high.error_m, 0.01, 1e-12);
  assert_true(high.velocity_mps > 0.0);
  const BladeKinematics blade(profile().blade);
  const double edge_mps =
      high.velocity_mps / blade.stroke_rate_mprad(0.0) * blade.edge_rate_mprad(0.0).y();
  assert_near(edge_mps, -profile().control.blade_gain_ps * 0.01, 1e-9);
  assert_near(command(test::level(0.01), driving(0.0, 0.0)).velocity_mps, -high.velocity_mps, 1e-9);
}

/// Feed-forward: with it the edge keeps its height over the design whatever the body does.
void the_bodys_motion_is_made_up_for(void**) {
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

/// The design is read where the edge will be when the cylinders answer.
void the_design_is_read_ahead(void**) {
  const BladeKinematics blade(profile().blade);
  GradeDesign bent = test::bend(-0.3, 0.1);
  const double edge_x_m = blade.edge_m(0.0).x();
  BladeSituation now = driving(1.0, 0.0);
  // The bend begins a centimetre further on than it is now.
  now.body.position_m.x() = 9.9 - 0.01 - edge_x_m;
  const BladeCommand ahead = command(bent, now);
  assert_near(ahead.feed_forward_mps, 0.0, 1e-12);
  assert_true(ahead.velocity_mps > 0.001);
}

/// A body that begins to rise: asked for is what it will do, not what it does.
void a_growing_motion_is_carried_on(void**) {
  BladeState state;
  BladeCommand last;
  for (int n = 0; n < 20; ++n) {
    BladeSituation now = driving(0.0, 0.0);
    now.body_velocity[2] = 0.01 * n;
    last = command(test::level(0.0), now, state);
    state = last.state;
  }
  assert_near(state.carried_rate_mps2, 1.0, 0.05);
  assert_true(last.velocity_mps > 1.1 * last.feed_forward_mps);
}

void what_stays_is_integrated_up_to_its_bound(void**) {
  BladeState state;
  for (int n = 0; n < 50; ++n) {
    state = command(test::level(-0.005), driving(0.0, 0.0), state).state;
  }
  assert_near(state.integral_mps, profile().control.blade_integral_ps2 * 0.005 * 0.5, 1e-9);
  for (int n = 0; n < 5000; ++n) {
    state = command(test::level(-0.005), driving(0.0, 0.0), state).state;
  }
  assert_near(state.integral_mps, profile().control.blade_integral_most_mps, 1e-9);
}

/// While the pump can't feed what is asked for, nothing winds up.
void out_of_flow_the_integral_stands_still(void**) {
  const BladeState state = command(test::level(-0.3), driving(0.0, 0.0)).state;
  assert_near(state.integral_mps, 0.0, 0.0);
}

void towards_its_ends_it_slows_down(void**) {
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

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(on_the_grade_it_rests),
      cmocka_unit_test(an_error_is_taken_back),
      cmocka_unit_test(the_bodys_motion_is_made_up_for),
      cmocka_unit_test(the_design_is_read_ahead),
      cmocka_unit_test(a_growing_motion_is_carried_on),
      cmocka_unit_test(what_stays_is_integrated_up_to_its_bound),
      cmocka_unit_test(out_of_flow_the_integral_stands_still),
      cmocka_unit_test(towards_its_ends_it_slows_down),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
