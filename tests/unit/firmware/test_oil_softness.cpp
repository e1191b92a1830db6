// SPDX-License-Identifier: Apache-2.0
// Oil that is taken for softer or stiffer: by a boom that rings slower or faster than its mode, and
// by nothing else.

#include <cmath>

#include "firmware/core/time.hpp"
#include "firmware/excavator/estimation/oil/oil_softness.hpp"
#include "firmware/excavator/estimation/oil/tuning.hpp"
#include "tests/unit/cmocka_cpp.hpp"

constexpr double kMode_radps = 13.0;
constexpr double kMean_pa = 10e6;  ///< Of the links' weight.

/// The boom swings for so long by `rms_pa` at `omega_radps`; its mode is as slow as its share says.
OilSoftness swung(double rms_pa, double omega_radps, double time_s, bool judges = true,
                  OilSoftness state = {}) {
  next_softness(kMean_pa, kMode_radps, false, kCyclePeriod_s, state);
  for (double t_s = 0.0; t_s < time_s; t_s += kCyclePeriod_s) {
    next_softness(kMean_pa + std::sqrt(2.0) * rms_pa * std::sin(omega_radps * t_s),
                  kMode_radps * std::sqrt(state.share), judges, kCyclePeriod_s, state);
  }
  return state;
}

TEST(a_slow_swing_is_soft_oil) {
  const OilSoftness state = swung(3e6, 0.8 * kMode_radps, 6.0);
  // At the least as soft as makes the mode as slow as what is seen.
  assert_true(state.share < 0.72);
  assert_true(state.share >= kSoftOilLeast);
}

TEST(it_is_never_softer_than_the_least) {
  const OilSoftness state = swung(3e6, 0.5 * kMode_radps, 20.0);
  assert_true(state.share == kSoftOilLeast);
}

TEST(a_small_swing_says_nothing) {
  assert_true(swung(0.8 * kRings_pa, 0.8 * kMode_radps, 6.0).share == 1.0);
}

TEST(a_fast_swing_is_stiff_oil) {
  const OilSoftness state = swung(3e6, 1.5 * kMode_radps, 6.0);
  assert_true(state.share > 1.3 && state.share <= kStiffOilMost);
  assert_true(swung(3e6, 2.5 * kMode_radps, 20.0).share == kStiffOilMost);
}

TEST(what_was_too_soft_stiffens_again) {
  OilSoftness soft;
  soft.share = 0.7;
  assert_true(swung(3e6, 1.3 * kMode_radps, 6.0, true, soft).share > 0.9);
}

TEST(what_swings_as_its_mode_is_left) {
  // What begins at once is faster for half a swing.
  assert_near(swung(3e6, 1.05 * kMode_radps, 6.0).share, 1.0, 0.1);
}

TEST(what_pushes_the_teeth_is_not_judged) {
  OilSoftness soft;
  soft.share = 0.8;
  const OilSoftness state = swung(3e6, 0.8 * kMode_radps, 6.0, false, soft);
  assert_true(state.share == 0.8);
  assert_true(state.power_pa2 == 0.0);
}

TEST(the_weight_of_another_pose_is_no_swing) {
  OilSoftness state;
  next_softness(kMean_pa, kMode_radps, false, kCyclePeriod_s, state);
  // Half of the links' weight in two seconds.
  for (double t_s = 0.0; t_s < 2.0; t_s += kCyclePeriod_s) {
    next_softness(kMean_pa * (1.0 - 0.25 * t_s), kMode_radps, true, kCyclePeriod_s, state);
  }
  assert_true(state.share == 1.0);
}

/// A cycle that comes late, or twice at the same time, divides by nothing.
TEST(no_time_changes_nothing) {
  OilSoftness state = swung(3e6, 0.8 * kMode_radps, 3.0);
  const double share = state.share;
  next_softness(kMean_pa + 5e6, kMode_radps, true, 0.0, state);
  assert_true(state.share == share);
  next_softness(kMean_pa + 5e6, kMode_radps, true, 0.05, state);
  assert_true(std::isfinite(state.rate_pa2ps2) && state.share <= share);
}
