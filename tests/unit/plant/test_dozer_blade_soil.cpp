// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "app/machines/simulated/simulated_dozer.hpp"
#include "app/machines/simulated/soil_kinds.hpp"
#include "app/plant/dozer_blade_soil.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/refusal.hpp"

using plant::BladeSoil;
using plant::Terrain;

const plant::DozerPlantProfile& profile() {
  static const machines::SimulatedDozer machine =
      machines::load_simulated_dozer(machines::find_profile("dozer_9t"));
  return machine.plant;
}

plant::SoilKind loam() { return machines::ground_of("loam", false, 0); }

Terrain level() { return {-2.0, 30.0, 0.02}; }

/// Straight from one place to the other in steps of a millimetre.
void go(BladeSoil& soil, Terrain& terrain, double from_m, double to_m, double edge_m) {
  const int steps = static_cast<int>(std::lround((to_m - from_m) / 0.001));
  for (int n = 0; n < steps; ++n) {
    soil.move({from_m + n * 0.001, edge_m}, {from_m + (n + 1) * 0.001, edge_m}, terrain);
  }
}

/// What is cut is before the blade or lost: swollen, over its width.
TEST(nothing_of_what_is_cut_disappears) {
  BladeSoil soil(loam(), profile());
  Terrain terrain = level();
  go(soil, terrain, 0.0, 2.0, -0.1);
  const double cut_m3 = 2.0 * 0.1 * profile().blade_shape.width_m * loam().swell;
  assert_near(soil.carried_m3() + soil.lost_m3(), cut_m3, 0.02 * cut_m3);
  assert_near(terrain.height_m(1.0), -0.1, 1e-9);
}

/// A blade holds no more than its height does; the rest runs off at its ends.
TEST(more_than_it_holds_runs_off) {
  BladeSoil soil(loam(), profile());
  Terrain terrain = level();
  go(soil, terrain, 0.0, 15.0, -0.2);
  const plant::BladeShape& blade = profile().blade_shape;
  const double holds_m3 =
      0.5 * blade.height_m * blade.height_m / std::tan(loam().repose_rad) * blade.width_m;
  assert_true(soil.carried_m3() <= holds_m3 * (1.0 + 1e-9));
  assert_true(soil.carried_m3() > 0.9 * holds_m3);
  assert_true(soil.lost_m3() > 1.0);
}

/// Over a dip it fills to its edge, as far as the prism goes.
TEST(it_fills_what_lies_below_its_edge) {
  BladeSoil soil(loam(), profile());
  Terrain terrain = level();
  terrain.cut({5.0, -0.05}, {6.0, -0.05});
  go(soil, terrain, 0.0, 4.0, -0.1);
  const double before_m3 = soil.carried_m3();
  assert_near(terrain.height_m(5.5), -0.05, 1e-9);
  go(soil, terrain, 4.0, 7.0, 0.0);
  assert_near(terrain.height_m(5.5), 0.0, 5e-3);
  assert_true(soil.carried_m3() < before_m3);
}

/// Backward it leaves what it has carried, and cuts nothing forward of it.
TEST(going_back_it_lets_go) {
  BladeSoil soil(loam(), profile());
  Terrain terrain = level();
  go(soil, terrain, 0.0, 2.0, -0.1);
  soil.move({2.0, 0.2}, {1.999, 0.2}, terrain);
  assert_near(soil.carried_m3(), 0.0, 0.0);
}

/// The fundamental equation of earthmoving without a prism, worked out here by itself.
TEST(an_empty_blade_has_the_force_of_the_equation) {
  const BladeSoil soil(loam(), profile());
  const Terrain terrain = level();
  constexpr double kDepth_m = 0.1;
  const double rake_rad = profile().blade_shape.rake_rad;
  const Eigen::Vector2d force_n = soil.force_n({5.0, -kDepth_m}, {1.0, 0.0}, 0.0, terrain);
  const plant::CuttingForce expected =
      cutting_force(loam(), plant::cutting_factors(loam(), rake_rad), rake_rad, kDepth_m,
                    profile().blade_shape.width_m, 0.0, 9.80665);
  assert_true(-force_n.x() > expected.against_n);
  assert_near(-force_n.x(), expected.against_n, 0.15 * expected.against_n);
  assert_true(-force_n.x() > 5e3 && -force_n.x() < 30e3);
}

TEST(deeper_fuller_and_downwards_is_harder) {
  BladeSoil soil(loam(), profile());
  Terrain terrain = level();
  const auto against_n = [&](double depth_m) {
    return -soil.force_n({10.0, -depth_m}, {1.0, 0.0}, 0.0, terrain).x();
  };
  const double empty_n = against_n(0.1);
  assert_true(against_n(0.2) > 2.0 * empty_n);
  assert_true(soil.force_n({10.0, -0.1}, {1.0, -0.2}, 0.0, terrain).y() >
              soil.force_n({10.0, -0.1}, {1.0, 0.0}, 0.0, terrain).y() + 3e3);
  go(soil, terrain, 0.0, 6.0, -0.15);
  assert_true(against_n(0.1) > empty_n + 5e3);
  assert_true(against_n(0.0) > 3e3);
}

TEST(at_rest_and_backward_nothing_resists) {
  const BladeSoil soil(loam(), profile());
  const Terrain terrain = level();
  assert_near(soil.force_n({5.0, -0.1}, {0.0, 0.0}, 0.0, terrain).norm(), 0.0, 0.0);
  assert_near(soil.force_n({5.0, -0.1}, {-1.0, 0.0}, 0.0, terrain).norm(), 0.0, 0.0);
}

TEST(a_drawn_soil_is_within_forty_percent) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const plant::SoilKind drawn = machines::ground_of("clay", true, seed);
    const plant::SoilKind told = machines::ground_of("clay", false, seed);
    assert_true(std::abs(drawn.cohesion_pa / told.cohesion_pa - 1.0) <= 0.4);
    assert_true(drawn.cohesion_pa != told.cohesion_pa);
  }
  graben::test::expect_refusal([] { return machines::ground_of("snow", false, 0); }, "snow");
}
