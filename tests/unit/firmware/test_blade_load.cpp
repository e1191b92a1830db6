// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "firmware/dozer/travel/blade_load.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/dozer_fixture.hpp"

constexpr double kPeriod_s = 0.01;

const DozerProfile& profile() { return test::dozer().profile; }

/// Both tracks push with this, and slip by that share.
DozerValid pushing(double force_n, double slip) {
  const HstProfile& hst = profile().hst;
  DozerValid valid;
  valid.velocity_mps = 1.0 - slip;
  const double per_pa =
      2.0 * hst.motor_m3prev / 6.283185307179586 * hst.gear_ratio / hst.sprocket_radius_m;
  for (unsigned i = 0; i < kTrackCount; ++i) {
    valid.motor_ratio[i] = 1.0;
    valid.track_speed_mps[i] = 1.0;
    valid.line_pressure_pa[i] = 2.5e6 + force_n / per_pa;
  }
  return valid;
}

PushState after(const DozerValid& valid, double seconds, PushState state = {}) {
  for (int n = 0; n < static_cast<int>(seconds / kPeriod_s + 0.5); ++n) {
    state = next_load(profile(), state, valid, kPeriod_s);
  }
  return state;
}

TEST(the_push_is_that_of_the_lines) {
  assert_near(push_n(profile(), pushing(40e3, 0.0)), 40e3, 1e-6);
  DozerValid climbing = pushing(40e3, 0.0);
  climbing.pitch_rad = 0.1;
  assert_near(push_n(profile(), climbing), 40e3 - 8900.0 * 9.80665 * std::sin(0.1), 1e-6);
  DozerValid untold = pushing(0.0, 0.0);
  untold.line_pressure_pa = {};
  assert_near(push_n(profile(), untold), 0.0, 1e-9);
}

TEST(slip_is_what_the_faster_track_loses) {
  assert_near(slip_of(pushing(0.0, 0.3)), 0.3, 1e-12);
  DozerValid back = pushing(0.0, 0.0);
  back.track_speed_mps = {-1.0, -1.0};
  assert_near(slip_of(back), 0.0, 0.0);
}

TEST(what_it_can_push_it_pushes) {
  assert_near(after(pushing(0.8 * profile().travel.push_max_n, 0.0), 5.0).lift_m, 0.0, 0.0);
}

TEST(too_much_of_a_push_lifts_the_blade) {
  const PushState little = after(pushing(1.1 * profile().travel.push_max_n, 0.0), 1.0);
  const PushState more = after(pushing(1.3 * profile().travel.push_max_n, 0.0), 1.0);
  assert_true(little.lift_m > 0.005);
  assert_true(more.lift_m > 1.5 * little.lift_m);
  assert_true(more.rate_mps > 0.0);
  assert_true(after(pushing(9.0 * profile().travel.push_max_n, 0.0), 60.0).lift_m < 0.5);
}

/// However soft the ground under the tracks.
TEST(tracks_that_dig_themselves_in_lift_it_too) {
  assert_true(after(pushing(0.2 * profile().travel.push_max_n, 0.4), 1.0).lift_m > 0.05);
}

TEST(then_it_comes_down_again) {
  const PushState high = after(pushing(1.3 * profile().travel.push_max_n, 0.0), 1.0);
  const PushState down = after(pushing(0.2 * profile().travel.push_max_n, 0.0), 5.0, high);
  assert_near(down.lift_m, 0.0, 0.0);
  assert_near(down.rate_mps, 0.0, 0.0);
}

/// A load that grows is met before it is too much.
TEST(a_load_that_rises_counts_as_what_it_will_be) {
  PushState state = after(pushing(0.0, 0.0), 1.0);
  double lifted_at = 0.0;
  for (int n = 0; n < 100 && lifted_at <= 0.0; ++n) {
    const double share = 0.01 * n;
    state =
        next_load(profile(), state, pushing(share * profile().travel.push_max_n, 0.0), kPeriod_s);
    lifted_at = state.lift_m > 0.0 ? share : 0.0;
  }
  assert_true(lifted_at > 0.5 && lifted_at < 0.95);
}

/// A quarter of the planned flow is kept from twice 0.3 of what the tracks may push on.
TEST(a_load_keeps_a_reserve_of_flow) {
  const TravelProfile& travel = test::dozer().profile.travel;
  const auto share_at = [&](double push) {
    PushState load;
    load.push_n = push * travel.push_max_n;
    return planned_share(travel, load) / travel.flow_share;
  };
  assert_near(share_at(-0.5), 1.0, 1e-12);
  assert_near(share_at(0.3), 1.0, 1e-12);
  assert_near(share_at(0.45), 0.875, 1e-12);
  assert_near(share_at(0.6), 0.75, 1e-12);
  assert_near(share_at(2.0), 0.75, 1e-12);
}
