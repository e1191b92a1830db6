// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/dig/dig_layers.hpp"

#include <algorithm>

#include "firmware/excavator/motion/dig/tuning.hpp"
#include "tests/unit/cmocka_cpp.hpp"

/// 2 m of ground that stands 0.5 m over its design, for a bucket of 1 m.
LayerPlan plan() {
  LayerPlan plan;
  plan.step = 0;
  plan.ground_from_m = 0.5;
  plan.ground_to_m = 0.5;
  plan.way_m = 2.0;
  plan.width_m = 1.0;
  plan.bucket_m = 1.23;
  plan.full_m3 = 0.4;
  plan.depth_most_m = 0.35;
  return plan;
}

/// The edge along the whole line at a height.
double cut_through(const LayerPlan& plan, double height_m, CutState& state) {
  return pass(plan, 1.0, 0.0, height_m, state);
}

/// The next cut, whole, and what it has filled by its own account.
void cut_next(const LayerPlan& plan, double filled_m3, CutState& state) {
  static_cast<void>(cut_through(plan, state.cut.height_m, state));
  state.loaded_m3 = 0.0;
  next_cut(plan, {0.7, filled_m3}, state);
}

/// All of it, each cut with this share of a full bucket.
CutState dug(const LayerPlan& plan, CutState state, double filled = 0.2) {
  while (!state.met) {
    cut_next(plan, filled * plan.full_m3, state);
  }
  return state;
}

constexpr CutEnd kEven{0.7, 0.4};
constexpr CutEnd kNothing{0.7, 0.0};

TEST(a_cut_fills_the_bucket) {
  const LayerPlan whole = plan();
  const CutState state = undug(whole);
  assert_near(state.cut.volume_m3, filling_m3(whole, state), 1e-4);
  assert_near(state.cut.height_m, 0.5 - 0.4 / 0.9 / 2.0, 1e-4);
  assert_near(state.cut.from_share, 0.0, 0.0);
  assert_true(state.cut.enters_m > 0.5);
  assert_false(state.met || state.cut.thin);
  LayerPlan large = plan();
  large.full_m3 = 4.0;
  assert_near(undug(large).cut.height_m, 0.5 - 0.35, 1e-6);
}

/// Where a bucket that is a little fuller each time saves a round, all of them are.
TEST(a_little_more_saves_a_round) {
  LayerPlan whole = plan();
  whole.ground_from_m = 0.6;
  whole.ground_to_m = 0.6;
  const double above_m3 = (0.6 - kSparedAt_share * whole.bucket_m) * whole.way_m * whole.width_m;
  whole.full_m3 = 0.9 * above_m3 / 2.2;
  const double full_m3 = filling_m3(whole, undug(whole));
  const CutState state = undug(whole);
  assert_near(state.cut.volume_m3, 0.5 * above_m3, 1e-3);
  assert_true(state.cut.volume_m3 > 1.08 * full_m3);
  // Far more would not stay in.
  whole.full_m3 = 0.9 * above_m3 / 2.7;
  assert_near(undug(whole).cut.volume_m3, filling_m3(whole, undug(whole)), 1e-3);
}

/// What is carried away is weighed against what the edge has passed.
TEST(a_bucket_that_came_back_half_empty_takes_more) {
  const LayerPlan whole = plan();
  const auto filling_after = [&](double filled_m3, double weighed_m3) {
    CutState state = undug(whole);
    static_cast<void>(cut_through(whole, state.cut.height_m, state));
    next_cut(whole, {0.7, filled_m3}, state);
    weigh_cut(whole, weighed_m3, state);
    return filling_m3(whole, state);
  };
  const double first_m3 = filling_m3(whole, undug(whole));
  assert_true(filling_after(0.44, 0.33) > 1.05 * first_m3);
  assert_true(filling_after(0.44, 0.44) < 0.97 * first_m3);
  assert_near(filling_after(0.44, 0.01), 0.4 / 0.75, 1e-9);
  assert_near(filling_after(0.44, 0.0), first_m3, 1e-12);
  // A little says nothing of a full one.
  assert_near(filling_after(0.1, 0.01), first_m3, 1e-12);
}

/// What a last cut can take is not worth a bucket of its own.
TEST(a_thick_last_layer_is_the_last) {
  const LayerPlan whole = plan();
  const auto after = [&](double left_m) {
    CutState state = undug(whole);
    static_cast<void>(cut_through(whole, left_m, state));
    next_cut(whole, kEven, state);
    return state.cut;
  };
  assert_true(after(0.12).thin);
  assert_near(after(0.12).height_m, 0.0, 1e-12);
  assert_false(after(0.15).thin);
}

/// A wall that was left at one end is taken with the rest, and no deeper than a cut may be.
TEST(what_stands_out_is_part_of_the_next_cut) {
  const LayerPlan whole = plan();
  CutState state = undug(whole);
  static_cast<void>(pass(whole, 0.75, 0.0, state.cut.height_m, state));
  const double floor_m = state.cut.height_m;
  next_cut(whole, kEven, state);
  assert_true(state.cut.height_m < floor_m);
  assert_near(state.cut.from_share, 0.0, 0.0);
  assert_true(0.5 - state.cut.height_m <= 1.5 * state.depth_m + 1e-6);
}

/// Each cut is lower, the last is thin, and then all is met.
TEST(goes_down_cut_by_cut) {
  const LayerPlan whole = plan();
  CutState state = undug(whole);
  double last_m = 0.5;
  double cut_m3 = 0.0;
  int cuts = 0;
  while (!state.met) {
    assert_true(state.cut.height_m < last_m);
    assert_true(state.cut.height_m >= 0.0);
    assert_true(state.cut.thin == (state.cut.height_m == 0.0));
    if (state.cut.thin) {
      assert_true(last_m <= kLastLayer_share * whole.bucket_m + kRough_m + 1e-6);
    }
    last_m = state.cut.height_m;
    const double got_m3 = cut_through(whole, last_m, state);
    cut_m3 += got_m3;
    next_cut(whole, {0.7, got_m3}, state);
    state.loaded_m3 = 0.0;
    assert_true(++cuts < 20);
  }
  assert_near(last_m, 0.0, 0.0);
  assert_near(cut_m3, 0.5 * 2.0 * 1.0, 1e-5);
}

TEST(only_what_was_passed_is_gone) {
  const LayerPlan whole = plan();
  CutState state = undug(whole);
  const double height_m = state.cut.height_m;
  const double half_m3 = pass(whole, 0.5, 0.0, height_m, state);
  assert_near(half_m3, (0.5 - height_m) * 1.0 * 1.0, 1e-5);
  assert_near(pass(whole, 0.5, 0.0, height_m, state), 0.0, 0.0);
  assert_near(pass(whole, 0.5, 0.0, height_m + 0.1, state), 0.0, 0.0);
}

/// One place that is a little rough is left, two are not; what is low already is passed over.
TEST(ends_where_next_to_nothing_is_left) {
  const LayerPlan whole = plan();
  CutState state = undug(whole);
  static_cast<void>(cut_through(whole, 0.0, state));
  auto& bins = state.height_m[0];
  bins[12] = 0.022F;
  next_cut(whole, kEven, state);
  assert_true(state.met);
  bins[12] = 0.030F;
  next_cut(whole, kEven, state);
  assert_false(state.met);
  assert_true(state.cut.thin && state.cut.from_share > 0.3 && state.cut.from_share < 0.5);
  bins[12] = 0.022F;
  bins[13] = 0.022F;
  next_cut(whole, kEven, state);
  assert_false(state.met);
}

TEST(strips_one_after_the_other) {
  LayerPlan wide = plan();
  wide.strips = 3;
  CutState state = undug(wide);
  for (int strip = 0; strip < 3; ++strip) {
    assert_int_equal(state.cut.strip, strip);
    const double height_m = state.cut.height_m;
    static_cast<void>(cut_through(wide, height_m, state));
    next_cut(wide, kEven, state);
    assert_true(strip == 2 || state.cut.height_m == height_m);
    state.loaded_m3 = 0.0;
  }
  assert_int_equal(state.cut.strip, 0);
}

/// Soil that does not go is left, and the task comes to its end.
TEST(what_stays_up_is_left) {
  const LayerPlan whole = plan();
  CutState state = undug(whole);
  int cuts = 0;
  for (; !state.met; ++cuts) {
    assert_true(cuts < kCutsMost);
    next_cut(whole, kNothing, state);
  }
  assert_true(cuts >= kTriesMost && cuts < 40);
}

/// A cut that was stopped where it went in says nothing of the rest of its strip.
TEST(the_rest_of_a_strip_is_cut_all_the_same) {
  const LayerPlan whole = plan();
  CutState state = undug(whole);
  for (int n = 0; n < kTriesMost; ++n) {
    assert_true(state.cut.from_share == 0.0);
    next_cut(whole, {1.2, 0.0, 0.03}, state);
  }
  assert_false(state.met);
  assert_true(state.cut.from_share >= 0.0);
  assert_true(state.height_m[0][0] <= static_cast<float>(state.cut.enters_m));
  assert_true(state.height_m[0][kStripBins - 1] > 0.3F);
  int cuts = 0;
  for (; !state.met; ++cuts) {
    assert_true(cuts < kCutsMost);
    next_cut(whole, {1.2, 0.0, state.cut.from_share + 0.03}, state);
  }
}

TEST(depth_follows_the_force) {
  const LayerPlan whole = plan();
  CutState state = undug(whole);
  const double first_m = state.depth_m;
  next_cut(whole, {1.2, 0.4}, state);
  assert_true(state.depth_m < first_m);
  next_cut(whole, {0.7, 0.4}, state);
  assert_true(state.depth_m < first_m);
  for (int n = 0; n < 20; ++n) {
    next_cut(whole, {0.2, 0.4}, state);
  }
  assert_near(state.depth_m, whole.depth_most_m, 0.0);
  for (int n = 0; n < 20; ++n) {
    next_cut(whole, {2.0, 0.4}, state);
  }
  assert_true(state.depth_m > 0.0);
}

/// However heavy it was on average: what it got says how much too deep it was.
TEST(a_cut_that_gave_way_is_less_deep_at_once) {
  const LayerPlan whole = plan();
  CutState state = undug(whole);
  const double first_m = state.depth_m;
  const double wanted_m3 = std::min(state.cut.volume_m3, filling_m3(whole, state));
  next_cut(whole, {0.7, 0.4 * wanted_m3}, state);
  assert_near(state.depth_m, 0.6 * first_m, 1e-9);
  state = undug(whole);
  next_cut(whole, {0.7, 0.02 * wanted_m3}, state);
  assert_near(state.depth_m, kShallowest * first_m, 1e-9);
  // Nothing tells of the depth of a light one, or of one that was stopped where it went in.
  for (const CutEnd& end : {CutEnd{0.3, 0.02, 1.0}, CutEnd{0.7, 0.02, 0.1}}) {
    state = undug(whole);
    next_cut(whole, end, state);
    assert_true(state.depth_m >= first_m);
  }
}

/// A machine that is too weak for the least depth presses harder, within what its cylinders hold.
TEST(a_weak_machine_presses_harder) {
  const LayerPlan whole = plan();
  CutState state = undug(whole);
  double last_m = state.depth_m;
  for (int n = 0; n < 12; ++n) {
    next_cut(whole, {1.1, 0.05}, state);
    assert_true(state.force == 1.0 || last_m <= kHarderFrom * kDepthLeast_share * whole.bucket_m);
    last_m = state.depth_m;
  }
  assert_near(state.depth_m, kDepthLeast_share * whole.bucket_m, 1e-9);
  assert_near(state.force * kForceUsed, kForceMost, 1e-9);
}

/// Broken off, it says nothing of its depth, and leaves nothing up.
TEST(an_abandoned_cut_is_cut_again) {
  const LayerPlan whole = plan();
  CutState state = undug(whole);
  const CutState first = state;
  state.filled_m3 = 0.1;
  repeat(10, [&] { abandon_cut(whole, state); });
  assert_true(state.height_m == first.height_m);
  assert_near(state.depth_m, first.depth_m, 0.0);
  assert_near(state.loaded_m3, 0.1, 1e-12);
  assert_false(state.met);
}

/// A cut that brings more than its edge has passed is made again, so often and no more.
TEST(soil_that_falls_in_is_swept_out) {
  const LayerPlan whole = plan();
  CutState state = undug(whole);
  weigh_cut(whole, whole.full_m3, state);
  assert_int_equal(state.sweeps[0], 0);
  state = dug(whole, state);
  CutState light = state;
  weigh_cut(whole, 0.27 * whole.full_m3, light);
  assert_true(light.met);
  CutState more = state;
  weigh_cut(whole, 0.30 * whole.full_m3, more);
  assert_false(more.met);
  int sweeps = 0;
  for (; sweeps < 100; ++sweeps) {
    weigh_cut(whole, whole.full_m3, state);
    if (state.met) {
      break;
    }
    assert_true(state.cut.thin);
    // Not weighed it is no reason for another.
    CutState once = state;
    once.met = true;
    weigh_cut(whole, whole.full_m3, once);
    assert_true(once.met);
    cut_next(whole, 0.2 * whole.full_m3, state);
  }
  assert_int_equal(sweeps, kSweepsMost);
}

/// A last cut that brings much has moved what stands beside it, whatever its edge has passed.
TEST(a_heavy_last_cut_is_swept_after) {
  const LayerPlan whole = plan();
  CutState state = dug(whole, undug(whole), 0.8);
  CutState light = state;
  weigh_cut(whole, 0.3 * whole.full_m3, light);
  assert_true(light.met);
  weigh_cut(whole, 0.8 * whole.full_m3, state);
  assert_false(state.met);
  assert_int_equal(state.sweeps[0], 1);
}

/// A sweep takes what nobody has seen: all that it brings has fallen in.
TEST(what_a_sweep_brings_has_fallen_in) {
  const LayerPlan whole = plan();
  CutState state = dug(whole, undug(whole));
  weigh_cut(whole, 0.5 * whole.full_m3, state);
  assert_false(state.met);
  assert_false(state.wall_falls);
  static_cast<void>(cut_through(whole, state.cut.height_m, state));
  state.loaded_m3 = 0.3 * whole.full_m3;
  next_cut(whole, {0.7, 0.0}, state);
  weigh_cut(whole, 0.3 * whole.full_m3, state);
  assert_int_equal(state.sweeps[0], 2);
}

/// Nearly a full bucket of it: the far wall falls in. It is cut back until it stands.
TEST(a_wall_that_stops_a_sweep_stands) {
  const LayerPlan whole = plan();
  CutState state = dug(whole, undug(whole));
  weigh_cut(whole, 0.9 * whole.full_m3, state);
  assert_true(state.wall_falls);
  state.cut.from_share = -0.2;
  next_cut(whole, {1.4, 0.0}, state);
  assert_false(state.wall_falls);
  assert_false(state.met);
}

/// A wall that lets soil in again and again is cut back too, however little it is at a time.
TEST(a_wall_that_crumbles_is_cut_back) {
  const LayerPlan whole = plan();
  CutState state = dug(whole, undug(whole));
  for (int sweep = 0; sweep < 2; ++sweep) {
    assert_false(state.wall_falls);
    weigh_cut(whole, 0.5 * whole.full_m3, state);
    assert_false(state.met);
    cut_next(whole, 0.2 * whole.full_m3, state);
  }
  weigh_cut(whole, 0.5 * whole.full_m3, state);
  assert_true(state.wall_falls);
}

/// Once all is through, each strip whose last cut brought more than its edge had passed.
TEST(every_strip_that_soil_fell_into_is_swept) {
  LayerPlan whole = plan();
  whole.strips = 3;
  CutState state = undug(whole);
  const auto cut = [&](double weighed_m3) {
    const int strip = state.cut.strip;
    cut_next(whole, 0.2 * whole.full_m3, state);
    weigh_cut(whole, weighed_m3, state);
    return strip;
  };
  while (!state.met && !state.swept) {
    // Into the first two.
    static_cast<void>(cut((state.cut.strip < 2 ? 0.8 : 0.2) * whole.full_m3));
  }
  std::array<int, 3> swept{};
  while (!state.met) {
    ++swept[static_cast<unsigned>(cut(0.01 * whole.full_m3))];
  }
  assert_int_equal(swept[0], 1);
  assert_int_equal(swept[1], 1);
  assert_int_equal(swept[2], 0);
}

/// Ground under the design is none to dig.
TEST(ground_below_its_design_is_met) {
  LayerPlan low = plan();
  low.ground_from_m = -0.2;
  low.ground_to_m = -0.1;
  assert_true(undug(low).met);
}
