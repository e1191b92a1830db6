// SPDX-License-Identifier: Apache-2.0
// What the implement's pump has been seen to give, of what its model says.

#include "firmware/dozer/flow_share.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/dozer_fixture.hpp"

constexpr double kPeriod_s = 0.01;
constexpr double kEngine_radps = 104.7;

const DozerProfile& profile() { return test::dozer().profile; }

double raising_mps(double share) {
  return -share * available_flow_m3ps(profile().implement, kEngine_radps) /
         profile().blade.rod_area_m2();
}

/// The valves should let through the first of these shares of the flow, and the cylinders take the
/// second.
FlowShareState after(double due_mps, double moving_mps, double seconds, FlowShareState state = {}) {
  FlowSituation now;
  now.engine_radps = kEngine_radps;
  now.due_mps[kBladeLift] = due_mps;
  now.stroke_m[kBladeLift] = state.stroke_m[kBladeLift];
  for (int n = 0; n < static_cast<int>(seconds / kPeriod_s + 0.5); ++n) {
    now.stroke_m[kBladeLift] += moving_mps * kPeriod_s;
    state = next_flow_share(profile(), state, now, kPeriod_s);
  }
  return state;
}

TEST(a_pump_that_gives_less_is_found_out) {
  const FlowShareState worn = after(raising_mps(1.0), raising_mps(0.9), 0.6);
  assert_near(worn.share, 0.9, 0.002);
  // Half of it as soon as a fall over a crest takes.
  assert_true(after(raising_mps(1.0), raising_mps(0.9), 0.15).share < 0.94);
}

TEST(what_it_gives_it_can_give) {
  assert_near(after(raising_mps(1.0), raising_mps(1.0), 1.0).share, 1.0, 0.002);
  // A valve that is to let through less says nothing of the pump.
  assert_near(after(raising_mps(0.85), raising_mps(0.85), 1.0).share, FlowShareState{}.share, 0.0);
  assert_near(after(raising_mps(0.5), raising_mps(0.2), 1.0).share, FlowShareState{}.share, 0.0);
}

TEST(a_blade_that_the_ground_holds_tells_nothing) {
  const double down_mps =
      available_flow_m3ps(profile().implement, kEngine_radps) / profile().blade.cap_area_m2();
  assert_near(after(down_mps, 0.5 * down_mps, 1.0).share, FlowShareState{}.share, 0.0);
}

TEST(no_pump_is_planned_with_that_gives_next_to_nothing) {
  assert_near(after(raising_mps(1.0), 0.0, 2.0).share, 0.8, 0.0);
}

TEST(what_was_not_commanded_does_not_count, FlowSituation now) {
  now.due_mps[kBladeLift] = raising_mps(1.0);
  FlowShareState state;
  repeat(100, [&] { state = next_flow_share(profile(), state, now, kPeriod_s); });
  assert_near(state.share, FlowShareState{}.share, 0.0);
}
