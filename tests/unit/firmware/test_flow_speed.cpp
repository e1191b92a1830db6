// SPDX-License-Identifier: Apache-2.0
// What a drive can do at its measured pressures and opening.

#include "tests/unit/firmware/flow_fixture.hpp"
#include "tests/unit/firmware/two_sides.hpp"

using namespace graben::test::of_flow;

/// What leaves the draining side, over its area; either way by its own edge.
TEST(the_draining_side_tells_the_speed) {
  const DriveRow row = plain();
  const double least = 0.88 * opening(0.6, -0.035);
  const double most = 1.12 * opening(0.6, 0.035);
  assert_range(possible_speed(row, nullptr, at(0.6, 9e6, 5e6), kEngine_radps),
               least * 2e-6 * std::sqrt(5e6 - kLost_pa) / 0.01,
               most * 2e-6 * std::sqrt(5e6 + kZero_pa) / 0.01);
  assert_range(possible_speed(row, nullptr, at(-0.6, 5e6, 9e6), kEngine_radps),
               -most * 5e-6 * std::sqrt(5e6 + kZero_pa) / 0.02,
               -least * 5e-6 * std::sqrt(5e6 - kLost_pa) / 0.02);
}

TEST(a_spool_in_its_dead_band_moves_nothing) {
  for (const double spool : {0.0, 0.16, -0.16}) {
    assert_range(possible_speed(plain(), nullptr, at(spool, 5e6, 5e6), kEngine_radps), 0.0, 0.0);
  }
  // At its edge it may be open.
  const SpeedRange edge = possible_speed(plain(), nullptr, at(0.2, 5e6, 5e6), kEngine_radps);
  assert_near(edge.least_mps, 0.0, 0.0);
  assert_true(edge.most_mps > 0.0);
}

/// Held by a rock there is no pressure left; the fed side's may push it back.
TEST(an_empty_side_carries_nothing) {
  const double most = 1.12 * opening(0.6, 0.035);
  assert_range(possible_speed(plain(), nullptr, at(0.6, 15e6, 1e6), kEngine_radps),
               -most * 4e-6 * std::sqrt(15e6 + kZero_pa) / 0.02,
               most * 2e-6 * std::sqrt(1e6 + kZero_pa) / 0.01);
  assert_range(possible_speed(plain(), nullptr, at(-0.6, 1e6, 15e6), kEngine_radps),
               -most * 5e-6 * std::sqrt(1e6 + kZero_pa) / 0.02,
               most * 3e-6 * std::sqrt(15e6 + kZero_pa) / 0.01);
  assert_true(
      possible_speed(plain(), nullptr, at(0.6, 15e6, kLost_pa + 1e5), kEngine_radps).least_mps >
      0.0);
}

/// Least: through the drain alone. Most: the check open to what the fed side has, or not at all.
TEST(a_regenerating_side_passes_drain_and_check) {
  DriveRow row = plain();
  row.spool.regeneration = RegenerationSide::kExtend;
  const double least_out = 0.88 * opening(0.6, -0.035) * 2e-6;
  const double most_out = 1.12 * opening(0.6, 0.035) * 2e-6;
  const double least_mps = series(least_out, 0.67e-6) * std::sqrt(16e6 - kLost_pa) / 0.01;
  const double drained = std::sqrt(16e6 + kZero_pa);
  assert_range(possible_speed(row, nullptr, at(0.6, 1e6, 16e6), kEngine_radps), least_mps,
               series(most_out, 3.99e-6) * drained / 0.01);
  assert_range(possible_speed(row, nullptr, at(0.6, 5e6, 16e6), kEngine_radps), least_mps,
               most_out * std::sqrt(11e6 + 2.0 * kZero_pa) / 0.01);
  assert_range(possible_speed(row, nullptr, at(0.6, 30e6, 16e6), kEngine_radps), least_mps,
               series(most_out, 1.33e-6) * drained / 0.01);
  // The other way it does not regenerate.
  assert_near(possible_speed(row, nullptr, at(-0.6, 5e6, 9e6), kEngine_radps).least_mps,
              -1.12 * opening(0.6, 0.035) * 5e-6 * std::sqrt(5e6 + kZero_pa) / 0.02, 1e-9);
  row.spool.regeneration = RegenerationSide::kRetract;
  assert_near(
      possible_speed(row, nullptr, at(-0.6, 16e6, 1e6), kEngine_radps).most_mps,
      -series(0.88 * opening(0.6, -0.035) * 5e-6, 0.67e-6) * std::sqrt(16e6 - kLost_pa) / 0.02,
      1e-9);
  assert_near(possible_speed(row, nullptr, at(0.6, 9e6, 5e6), kEngine_radps).most_mps,
              1.12 * opening(0.6, 0.035) * 2e-6 * std::sqrt(5e6 + kZero_pa) / 0.01, 1e-9);
}

/// To the last bit at the end of what bias and return line may take.
TEST(no_less_than_nothing_is_left) {
  assert_true(possible_speed(plain(), nullptr, at(0.6, 15e6, kLost_pa), kEngine_radps).least_mps <
              0.0);
}

/// Where the dead band is smaller than the sensor's error, a closed spool may be open either way.
TEST(without_a_dead_band_it_may_go_either_way) {
  DriveRow row = plain();
  const double opens[] = {0.0, 1.0};
  const double duty[] = {0.0, 1.0};
  assert_int_equal(row.answer.extend.spool_to_duty.fill(opens, duty, 2), MonotoneTable::Fill::kOk);
  row.answer.retract = row.answer.extend;
  const double most = 1.12 * 2e-6 * std::sqrt(5e6 + kZero_pa) / 0.01;
  assert_range(possible_speed(row, nullptr, at(0.01, 9e6, 5e6), kEngine_radps), -0.045 * most,
               0.045 * most);
  const double closed_mps = 1.12 * 0.035 * 5e-6 * std::sqrt(9e6 + kZero_pa) / 0.02;
  assert_range(possible_speed(row, nullptr, at(0.0, 9e6, 5e6), kEngine_radps), -closed_mps,
               closed_mps);
  assert_true(possible_speed(row, nullptr, at(0.04, 9e6, 5e6), kEngine_radps).least_mps > 0.0);
  assert_near(possible_speed(row, nullptr, at(0.035, 9e6, 5e6), kEngine_radps).least_mps,
              -0.07 * most, 1e-9);
}

/// At 2 the bound is the power itself.
TEST(an_orifices_square_is_exact) {
  DriveRow row = plain();
  row.metering.opening_exponent = 2.0;
  const double least = 0.88 * opening(0.3, -0.035) * opening(0.3, -0.035);
  assert_near(possible_speed(row, nullptr, at(0.3, 9e6, 5e6), kEngine_radps).least_mps,
              least * 2e-6 * std::sqrt(5e6 - kLost_pa) / 0.01, 1e-9);
}

/// From below, and near: openings that do not grow in proportion.
TEST(the_least_opening_is_a_lower_bound) {
  for (const double exponent : {0.7, 1.0, 1.3, 1.9, 2.5}) {
    DriveRow row = plain();
    row.metering.opening_exponent = exponent;
    for (const double spool : {0.24, 0.3, 0.6, 1.0}) {
      const SpeedRange range = possible_speed(row, nullptr, at(spool, 9e6, 5e6), kEngine_radps);
      const double per_opening_mps = 2e-6 * std::sqrt(5e6 - kLost_pa) / 0.01;
      const double least_mps = 0.88 * std::pow(opening(spool, -0.035), exponent) * per_opening_mps;
      assert_true(range.least_mps >= 0.0 && range.least_mps <= least_mps * (1.0 + 1e-9));
      assert_true(exponent > 2.0 || range.least_mps > 0.0);
      assert_true(spool < 0.6 || exponent < 1.0 || range.least_mps > 0.9 * least_mps);
    }
  }
}

TEST(a_metered_inlet_gives_its_flow_or_the_pumps) {
  const DriveRow row = metered_inlet();
  assert_range(possible_speed(row, nullptr, at(0.36, 0.0, 0.0), 1000.0),
               0.8 * opening(0.36, -0.035) * 2e-3 / 0.02, 1.2 * opening(0.36, 0.035) * 2e-3 / 0.02);
  assert_range(possible_speed(row, nullptr, at(-0.6, 0.0, 0.0), 10.0),
               -1.2 * opening(0.6, 0.035) * 2e-3 / 0.01, -0.8 * 1e-4 / 0.01);
}

TEST(leakage_takes_from_the_fed_side) {
  DriveRow row = plain();
  row.watch.leak_mpspa = 1e-9;
  assert_range(possible_speed(row, nullptr, at(0.0, 9e6, 4e6), kEngine_radps), -0.005, 0.0);
  assert_range(possible_speed(row, nullptr, at(0.0, 4e6, 9e6), kEngine_radps), 0.0, 0.005);
}

/// Not learnt yet, a valve may be open more or less; a learnt edge moves the bounds.
TEST(what_is_learnt_moves_the_bounds) {
  const ValidDrive seen = at(0.4, 9e6, 5e6);
  const LearntValve fresh;
  const SpeedRange profiled = possible_speed(plain(), nullptr, seen, kEngine_radps);
  const SpeedRange unknown = possible_speed(plain(), &fresh, seen, kEngine_radps);
  assert_true(unknown.least_mps < profiled.least_mps);
  assert_true(unknown.most_mps > profiled.most_mps);
  LearntValve later = as_profiled();
  later.extend.edge = 0.05;
  const SpeedRange less = possible_speed(plain(), &later, seen, kEngine_radps);
  assert_true(less.most_mps < profiled.most_mps);
  assert_true(less.least_mps < profiled.least_mps);
  const ValidDrive back = at(-0.4, 9e6, 5e6);
  assert_near(possible_speed(plain(), &later, back, kEngine_radps).least_mps,
              possible_speed(plain(), nullptr, back, kEngine_radps).least_mps, 0.0);
}

/// A metered inlet's opening is the profile's: nothing is learnt of it.
TEST(a_metered_inlet_is_not_learnt) {
  DriveRow row = plain();
  row.supply = {1e-3, 1e-3};
  const LearntValve fresh;
  const ValidDrive seen = at(0.4, 9e6, 5e6);
  assert_near(possible_speed(row, &fresh, seen, kEngine_radps).most_mps,
              possible_speed(row, nullptr, seen, kEngine_radps).most_mps, 0.0);
}

/// Openings of a side are those of its table, and as uncertain as it is steep there.
TEST(each_side_has_its_own_curve) {
  DriveRow row = plain();
  row.answer = test::two_sides();
  const auto most = [&](double spool_ratio) {
    const SpeedRange range = possible_speed(row, nullptr, at(spool_ratio, 9e6, 9e6), kEngine_radps);
    return std::max(range.most_mps, -range.least_mps);
  };
  const double out_mps = 1.12 * 2e-6 * std::sqrt(9e6 + kZero_pa) / 0.01;
  const double back_mps = 1.12 * 5e-6 * std::sqrt(9e6 + kZero_pa) / 0.02;
  // 0.1 of the travel is a quarter of the opening, then 0.5 of it three quarters.
  assert_near(most(0.45), (0.125 + 0.035 / 0.4) * out_mps, 1e-9);
  assert_near(most(0.75), (0.625 + 0.035 / (2.0 / 3.0)) * out_mps, 1e-9);
  // The bend is within what the travel is known to: by the steeper part.
  assert_near(most(0.52), (0.28 + 0.035 / 0.4) * out_mps, 1e-9);
  assert_near(most(-0.4), (0.2 + 0.035 / 0.75) * back_mps, 1e-9);
  assert_near(most(-0.3), (0.05 / 0.75 + 0.035 / 0.75) * back_mps, 1e-9);
  // In the dead band of that side, and beyond what the other's is.
  assert_near(most(0.3), 0.0, 0.0);
  assert_near(most(-0.2), 0.0, 0.0);
}
