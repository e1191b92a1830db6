// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/blade.hpp"
#include "firmware/dozer/travel/speed_limit.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/dozer_fixture.hpp"

constexpr double kEngine_radps = 157.08;
constexpr double kPeriod_s = 0.01;

const DozerProfile& profile() { return test::dozer().profile; }

SpeedDemand easy() {
  SpeedDemand demand;
  demand.desired_mps = 1.6;
  demand.measured_mps = 1.0;
  demand.available_flow_m3ps = available_flow_m3ps(profile().implement, kEngine_radps);
  demand.engine_radps = kEngine_radps;
  demand.ahead = {10.0, 10.0};
  return demand;
}

SpeedChoice after(const SpeedDemand& demand, double seconds, SpeedState state = {}) {
  SpeedChoice choice;
  choice.state = state;
  for (int n = 0; n < seconds / kPeriod_s; ++n) {
    choice = next_speed(profile(), choice.state, demand, kPeriod_s);
  }
  return choice;
}

TEST(it_rises_at_its_limit_to_what_is_desired) {
  const SpeedChoice early = after(easy(), 1.0);
  assert_near(early.state.speed_mps, 0.5, 1e-9);
  assert_int_equal(early.limit.kind, LimitKind::kRise);
  const SpeedChoice late = after(easy(), 5.0);
  assert_near(late.state.speed_mps, 1.6, 1e-12);
  assert_int_equal(late.limit.kind, LimitKind::kNone);
}

/// (13), (14).
TEST(the_transmission_holds_it) {
  SpeedDemand demand = easy();
  demand.desired_mps = 3.0;
  const SpeedChoice choice = after(demand, 9.0);
  assert_near(choice.state.speed_mps, 1.80, 0.005);
  assert_int_equal(choice.limit.kind, LimitKind::kTransmissionFlow);
  demand.heading_radps = 0.5;
  const SpeedChoice turning = after(demand, 9.0);
  assert_near(turning.state.speed_mps, 1.80 - 0.45, 0.005);
  assert_int_equal(turning.limit.index, kRight);
}

/// (10), (11): twice the flow at this speed means half the speed.
TEST(measured_flow_holds_it) {
  SpeedDemand demand = easy();
  demand.required_flow_m3ps = 2.0 * demand.available_flow_m3ps;
  SpeedState fast;
  fast.speed_mps = 1.0;
  const SpeedChoice choice = after(demand, 5.0, fast);
  assert_near(choice.allowed_mps, 0.5, 1e-3);
  assert_near(choice.state.speed_mps, 0.5, 1e-3);
  assert_int_equal(choice.limit.kind, LimitKind::kImplementFlow);
  // It rises no higher than to the share that is planned with.
  assert_near(after(demand, 5.0).state.speed_mps, 0.5 * profile().travel.flow_share, 1e-3);
}

/// Without flow nothing is divided by it; at standstill not by the speed.
TEST(what_is_zero_is_not_divided_by) {
  SpeedDemand demand = easy();
  demand.measured_mps = 0.0;
  demand.required_flow_m3ps = 0.0;
  assert_near(after(demand, 5.0).state.speed_mps, 1.6, 1e-12);
  demand.required_flow_m3ps = demand.available_flow_m3ps;
  assert_near(after(demand, 5.0).state.speed_mps, profile().travel.speed_min_mps, 1e-3);
}

/// v_min keeps it going; only the operator brings it to rest.
TEST(it_is_never_held_below_v_min) {
  SpeedDemand demand = easy();
  demand.ahead = {0.001, 0.001};
  demand.required_flow_m3ps = 50.0 * demand.available_flow_m3ps;
  assert_near(after(demand, 5.0).state.speed_mps, 0.1, 1e-12);
  demand.desired_mps = 0.0;
  assert_near(after(demand, 5.0).state.speed_mps, 0.0, 1e-12);
}

TEST(it_brakes_no_harder_than_it_may, SpeedState fast) {
  fast.speed_mps = 1.6;
  SpeedDemand demand = easy();
  demand.ahead = {0.2, 0.2};
  const SpeedChoice choice = next_speed(profile(), fast, demand, kPeriod_s);
  assert_near(choice.state.speed_mps,
              1.6 - 1.1 * profile().travel.deceleration_max_mps2 * kPeriod_s, 1e-12);
  assert_int_equal(choice.limit.kind, LimitKind::kAhead);
}

/// Algorithm 1: at home it rises to what is allowed, off home no further than the lowest ahead.
TEST(off_home_it_rises_no_higher_than_what_lies_ahead) {
  SpeedDemand demand = easy();
  demand.ahead = {1.5, 0.6};
  assert_near(after(demand, 6.0).state.speed_mps, 1.5, 1e-12);
  demand.blade_angle_rad = -0.1;
  assert_near(after(demand, 6.0).state.speed_mps, 0.6, 1e-12);
  demand.blade_angle_rad = 0.1;
  assert_near(after(demand, 6.0).state.speed_mps, 0.6, 1e-12);
  demand.blade_angle_rad = 0.5 * profile().travel.threshold_rad;
  assert_near(after(demand, 6.0).state.speed_mps, 1.5, 1e-12);
}

/// A limit that trembles lets it fall, and then stay.
TEST(a_trembling_limit_does_not_make_it_tremble, SpeedState state) {
  state.speed_mps = 0.8;
  int rises = 0;
  for (int n = 0; n < 1000; ++n) {
    SpeedDemand demand = easy();
    const double limit_mps = 0.8 + (n % 7 < 3 ? 0.02 : -0.02);
    demand.ahead = {limit_mps, limit_mps};
    const SpeedState next = next_speed(profile(), state, demand, kPeriod_s).state;
    rises += next.speed_mps > state.speed_mps ? 1 : 0;
    state = next;
  }
  assert_int_equal(rises, 0);
  assert_near(state.speed_mps, 0.78, 1e-12);
}

/// Off the grade it crawls, near it the error counts for nothing.
TEST(off_the_grade_it_slows_down) {
  SpeedDemand demand = easy();
  const double allowed_m = profile().grade.tolerance_m;
  demand.off_m = -kSpeedOnGrade * allowed_m;
  assert_near(after(demand, 6.0).state.speed_mps, 1.6, 1e-12);
  demand.off_m = 0.5 * (kSpeedOnGrade + kSpeedOffGrade) * allowed_m;
  const SpeedChoice half = after(demand, 6.0);
  assert_near(half.state.speed_mps, 0.1 + 0.5 * 1.5, 1e-3);
  assert_int_equal(half.limit.kind, LimitKind::kOffGrade);
  demand.off_m = -0.5;
  assert_near(after(demand, 6.0).state.speed_mps, 0.1, 1e-12);
}

TEST(constant_asks_neither_blade_nor_ground) {
  DozerProfile constant = profile();
  constant.travel.policy = SpeedPolicy::kConstant;
  SpeedDemand demand = easy();
  demand.required_flow_m3ps = 9.0 * demand.available_flow_m3ps;
  demand.ahead = {0.1, 0.1};
  demand.blade_angle_rad = 0.3;
  SpeedState state;
  repeat(500, [&] { state = next_speed(constant, state, demand, kPeriod_s).state; });
  assert_near(state.speed_mps, 1.6, 1e-12);
}
