// SPDX-License-Identifier: Apache-2.0
// The dozer's ground: heights between nodes, what the cutting edge takes away, Janosi and Hanamoto.

#include "app/plant/dozer_ground.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/plant/fixture/machines.hpp"

using namespace graben::plant;

constexpr double kCell = 0.02;

TEST(uncut_ground_is_flat_everywhere) {
  const Terrain terrain(-9.0, 37.0, kCell);
  for (const double x : {-100.0, -9.0, 0.013, 37.0, 100.0}) {
    assert_near(terrain.height_m(x), 0.0, 0.0);
    assert_near(terrain.mean_height_m(x, 0.1), 0.0, 0.0);
    assert_near(terrain.mean_slope(x, 0.1), 0.0, 0.0);
  }
  assert_near(terrain.begin_m(), -9.0, 0.0);
  assert_near(terrain.end_m(), 37.0, 1e-9);
}

TEST(the_edge_lowers_what_it_passes) {
  Terrain terrain(0.0, 4.0, kCell);
  terrain.cut({1.0, 0.0}, {2.0, -0.2});
  for (const double x : {1.1, 1.23, 1.5, 1.99}) {
    assert_near(terrain.height_m(x), -0.2 * (x - 1.0), 1e-9);
  }
  assert_near(terrain.height_m(0.98), 0.0, 0.0);
  assert_near(terrain.height_m(2.02), 0.0, 0.0);
  assert_near(terrain.mean_height_m(1.5, 0.1), -0.1, 1e-9);
  assert_near(terrain.mean_slope(1.5, 0.1), -0.2, 1e-9);
}

// A way in steps shorter than a cell, each of which may pass no node at all.
TEST(many_short_ways_cut_as_one_long) {
  Terrain terrain(0.0, 4.0, kCell);
  Eigen::Vector2d edge(1.0, 0.0);
  for (int i = 1; i <= 1300; ++i) {
    const Eigen::Vector2d next(1.0 + i / 1300.0, -0.2 * i / 1300.0);
    terrain.cut(edge, next);
    edge = next;
  }
  for (double x = 1.02; x < 1.98; x += 0.0137) {
    assert_near(terrain.height_m(x), -0.2 * (x - 1.0), 1e-9);
  }
}

TEST(nothing_is_raised) {
  Terrain terrain(0.0, 4.0, kCell);
  terrain.cut({1.0, -0.1}, {3.0, -0.1});
  terrain.cut({1.5, 0.3}, {2.5, 0.5});
  terrain.cut({1.5, -0.05}, {2.5, -0.05});
  for (double x = 1.1; x < 2.95; x += 0.05) {
    assert_near(terrain.height_m(x), -0.1, 1e-12);
  }
}

TEST(going_back_cuts_nothing) {
  Terrain terrain(0.0, 4.0, kCell);
  terrain.cut({3.0, -0.1}, {1.0, -0.1});
  for (double x = 0.5; x < 3.5; x += 0.05) {
    assert_near(terrain.height_m(x), 0.0, 0.0);
  }
}

TEST(an_edge_that_is_pressed_in_leaves_a_notch) {
  Terrain terrain(0.0, 4.0, kCell);
  terrain.cut({2.003, 0.1}, {2.004, -0.1});
  assert_near(terrain.height_m(2.0), -0.1, 1e-12);
  assert_near(terrain.height_m(2.02), 0.0, 0.0);
  assert_near(terrain.height_m(1.98), 0.0, 0.0);
  terrain.cut({2.004, -0.1}, {2.004, 0.2});
  assert_near(terrain.height_m(2.0), -0.1, 1e-12);
}

// Each end's height goes on beyond it, and what is cut out there is lost.
TEST(beyond_its_ends_the_last_height_goes_on) {
  Terrain terrain(0.0, 1.0, kCell);
  terrain.cut({-1.0, -0.1}, {3.0, -0.1});
  for (const double x : {-5.0, -0.001, 0.5, 1.0, 1.03, 8.0}) {
    assert_near(terrain.height_m(x), -0.1, 1e-12);
    assert_near(terrain.mean_height_m(x, 0.1), -0.1, 1e-12);
  }
}

// A step of one cell: seen over the wheel's width its slope has a bound.
TEST(the_mean_is_exact_and_smooths_a_step) {
  Terrain terrain(0.0, 4.0, kCell);
  terrain.cut({1.99, -0.3}, {3.5, -0.3});
  // Straight from 0 at 1.98 to -0.3 at 2.00; over 1.9 .. 2.1 that is -0.3 (0.1 + 0.01) / 0.2.
  assert_near(terrain.mean_height_m(2.0, 0.1), -0.165, 1e-9);
  // Narrower than a cell.
  assert_near(terrain.mean_height_m(1.99, 0.002), -0.15, 1e-9);
  for (double x = 1.7; x < 2.3; x += 0.001) {
    assert_true(std::abs(terrain.mean_slope(x, 0.1)) <= 0.3 / 0.2 + 1e-9);
    const double e = 1e-7;
    const double slope =
        (terrain.mean_height_m(x + e, 0.1) - terrain.mean_height_m(x - e, 0.1)) / (2.0 * e);
    assert_near(slope, terrain.mean_slope(x, 0.1), 1e-5);
  }
}

/// Janosi and Hanamoto over the contact, by hand.
double force_at(double slip, double load_n) {
  const DozerPlantProfile profile = dozer_9t();
  const double u = slip * profile.machine.body.track_contact_m / profile.ground.slip_modulus_m;
  return profile.ground.friction * load_n * (1.0 - (1.0 - std::exp(-u)) / u);
}

double settled_force(double track_mps, double ground_mps, double load_n, Traction& traction) {
  double force = 0.0;
  graben::repeat(200000, [&] { force = traction.step(track_mps, ground_mps, load_n, 5e-4); });
  return force;
}

TEST(steady_slip_gives_janosi_and_hanamotos_force) {
  for (const double slip : {0.002, 0.01, 0.05, 0.3}) {
    for (const double sign : {1.0, -1.0}) {
      Traction driven(dozer_9t());
      const double force = settled_force(sign * 1.5, sign * 1.5 * (1.0 - slip), 40e3, driven);
      assert_near(force, sign * force_at(slip, 40e3), 1.0);
      assert_near(driven.slip(), sign * slip, 1e-6);
      Traction braked(dozer_9t());
      const double brake = settled_force(sign * 1.5 * (1.0 - slip), sign * 1.5, 40e3, braked);
      assert_near(brake, -sign * force_at(slip, 40e3), 1.0);
    }
  }
}

TEST(no_more_than_friction_gives) {
  Traction traction(dozer_9t());
  for (int i = 0; i < 20000; ++i) {
    const double load = i < 10000 ? 40e3 : 0.0;
    const double force = traction.step(i % 3000 < 1500 ? 2.0 : -2.0, 0.0, load, 5e-4);
    assert_true(std::abs(force) <= 0.8 * load);
  }
}

// A track that stands does not creep: what is sheared stays sheared and holds.
TEST(a_held_track_holds) {
  Traction traction(dozer_9t());
  graben::repeat(10, [&] { static_cast<void>(traction.step(0.0, -1.0, 40e3, 5e-4)); });
  const double sheared = traction.shear_m();
  assert_true(sheared > 0.004);
  double force = 0.0;
  graben::repeat(100000, [&] { force = traction.step(0.0, 0.0, 40e3, 5e-4); });
  assert_near(traction.shear_m(), sheared, 1e-12);
  const double u = sheared / 0.02;
  assert_near(force, 0.8 * 40e3 * (1.0 - (1.0 - std::exp(-u)) / u), 1e-6);
}
