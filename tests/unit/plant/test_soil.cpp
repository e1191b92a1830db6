// SPDX-License-Identifier: Apache-2.0
// Soil: the cutting force beside closed forms, what a bucket cuts, carries and drops, slopes.

#include <cmath>

#include "app/machines/simulated/soil_kinds.hpp"
#include "app/plant/soil/bucket_soil.hpp"
#include "firmware/numeric/constants.hpp"
#include "tests/unit/cmocka_cpp.hpp"

using namespace graben::plant;
using machines::soil_kind;

constexpr double kGravity = 9.80665;
constexpr double kStep_s = 200e-6;

SoilKind soil_of(double friction_deg, double cohesion_pa) {
  SoilKind soil = *soil_kind("sand");
  soil.friction_rad = friction_deg * kPi / 180.0;
  soil.cohesion_pa = cohesion_pa;
  soil.wall_friction_rad = 0.0;
  return soil;
}

/// A smooth upright blade: Rankine's passive pressure, N_gamma = K_p / 2, N_c = 2 sqrt(K_p),
/// N_q = K_p, on a surface at 45 degrees less half of phi. The search goes in whole degrees.
TEST(an_upright_smooth_blade_meets_passive_pressure) {
  for (const double friction_deg : {10.0, 20.0, 30.0, 40.0}) {
    const SoilKind soil = soil_of(friction_deg, 5e3);
    const double k_p = std::pow(std::tan(0.25 * kPi + 0.5 * soil.friction_rad), 2);
    const CuttingFactors found = cutting_factors(soil, 0.5 * kPi);
    assert_near(found.gravity, 0.5 * k_p, 0.002 * k_p);
    assert_near(found.surcharge, k_p, 0.004 * k_p);
    assert_near(found.cohesion, 2.0 * std::sqrt(k_p), 0.02 * std::sqrt(k_p));
    assert_near(found.failure_rad, 0.25 * kPi - 0.5 * soil.friction_rad, 1.01 * kPi / 180.0);
    const CuttingForce force = cutting_force(soil, found, 0.5 * kPi, 0.4, 1.2, 2e3, kGravity);
    const double weight_pa = soil.density_kgpm3 * kGravity * 0.4;
    const double rankine_n =
        1.2 * 0.4 * (0.5 * weight_pa * k_p + 2.0 * soil.cohesion_pa * std::sqrt(k_p) + 2e3 * k_p);
    assert_near(force.against_n, rankine_n, 0.01 * rankine_n);
  }
}

/// A rough upright one: Coulomb's passive pressure with wall friction.
TEST(a_rough_blade_meets_coulombs_pressure) {
  for (const double wall_deg : {5.0, 15.0, 20.0}) {
    SoilKind soil = soil_of(30.0, 0.0);
    soil.wall_friction_rad = wall_deg * kPi / 180.0;
    const double phi = soil.friction_rad;
    const double delta = soil.wall_friction_rad;
    const double root = std::sqrt(std::sin(phi + delta) * std::sin(phi) / std::cos(delta));
    const double k_p = std::pow(std::cos(phi) / (1.0 - root), 2) / std::cos(delta);
    const CuttingFactors found = cutting_factors(soil, 0.5 * kPi);
    assert_near(found.gravity, 0.5 * k_p, 0.003 * k_p);
    const CuttingForce force = cutting_force(soil, found, 0.5 * kPi, 0.4, 1.2, 0.0, kGravity);
    const double whole_n = 0.5 * k_p * soil.density_kgpm3 * kGravity * 0.4 * 0.4 * 1.2;
    assert_near(force.against_n, whole_n * std::cos(delta), 0.01 * whole_n);
    assert_near(force.down_n, -whole_n * std::sin(delta), 0.01 * whole_n);
  }
}

/// A flatter blade cuts with less force, and is drawn down; a rough one needs more.
TEST(rake_and_roughness_tell) {
  const SoilKind loam = *soil_kind("loam");
  const auto force_at = [](const SoilKind& soil, double rake_deg) {
    const double rake = rake_deg * kPi / 180.0;
    return cutting_force(soil, cutting_factors(soil, rake), rake, 0.3, 1.0, 0.0, kGravity);
  };
  assert_true(force_at(loam, 30.0).against_n < force_at(loam, 60.0).against_n);
  assert_true(force_at(loam, 60.0).against_n < force_at(loam, 90.0).against_n);
  assert_true(force_at(loam, 30.0).down_n > 0.0);
  assert_true(force_at(loam, 90.0).down_n < 0.0);
  SoilKind smooth = loam;
  smooth.wall_friction_rad = 0.0;
  assert_true(force_at(smooth, 60.0).against_n < force_at(loam, 60.0).against_n);
}

/// Prandtl's 5.14 c of a soil without friction; Vesic's table at 30 degrees: N_q 18.4,
/// N_gamma 22.4.
TEST(ground_bears_as_tables_say) {
  assert_near(bearing_pa(soil_of(0.0, 10e3), 0.2, 0.0, kGravity), 10e3 * (kPi + 2.0), 1.0);
  const SoilKind sand = soil_of(30.0, 0.0);
  const double weight = sand.density_kgpm3 * kGravity;
  assert_near(bearing_pa(sand, 0.0, 1.0, kGravity), 18.4 * weight, 0.01 * 18.4 * weight);
  assert_near(bearing_pa(sand, 2.0, 0.0, kGravity), 22.4 * weight, 0.01 * 22.4 * weight);
}

DiggingProfile digging(const char* soil) {
  DiggingProfile profile;
  profile.soil = *soil_kind(soil);
  profile.bucket = {1.0, 0.6, 0.6, 0.015, 0.5};
  profile.pin_m = 1.2;
  return profile;
}

/// Edge from radius to radius at this height and attitude; the mean force on the way.
Eigen::Vector2d drag(BucketSoil& soil, double from_m, double to_m, double height_m,
                     double attitude_rad, double speed_mps = 0.5) {
  const auto steps = static_cast<int>(std::abs(to_m - from_m) / (speed_mps * kStep_s));
  Eigen::Vector2d sum_n = Eigen::Vector2d::Zero();
  for (int n = 1; n <= steps; ++n) {
    const double radius_m = from_m + (to_m - from_m) * n / steps;
    sum_n += soil.step({radius_m, height_m, attitude_rad, 0.0}).force_n / steps;
  }
  return sum_n;
}

/// A bank of soil is the same soil, higher up.
TEST(soil_lies_at_its_level) {
  DiggingProfile profile = digging("loam");
  BucketSoil low(profile, 1, kStep_s);
  profile.level_m = 0.75;
  BucketSoil high(profile, 1, kStep_s);
  const Eigen::Vector2d low_n = drag(low, 7.0, 6.5, -0.2, 1.4);
  const Eigen::Vector2d high_n = drag(high, 7.0, 6.5, 0.55, 1.4);
  assert_true(low_n.norm() > 1e3);
  assert_near((high_n - low_n).norm(), 0.0, 1e-6 * low_n.norm());
  assert_near(high.cut_m3(), low.cut_m3(), 1e-6);
}

/// What is cut is in the bucket, in the ground it is missing, and nothing is lost.
TEST(volume_is_kept) {
  BucketSoil soil(digging("loam"), 1, kStep_s);
  static_cast<void>(soil.step({7.0, -0.2, 1.4, 0.0}));
  const double room_m3 = soil.ground().firm_change_m3();
  drag(soil, 7.0, 6.0, -0.2, 1.4);
  const double swell = soil.profile().soil.swell;
  // A width of twenty cells, one metre long, 0.2 m deep; the ground fell in a little.
  assert_near(soil.cut_m3(), 0.2, 0.02);
  assert_near(soil.fill_m3() + soil.ground().loose_m3(),
              swell * (room_m3 - soil.ground().firm_change_m3()), 2e-3);
  assert_true(soil.fill_m3() > 0.1);
}

/// Whatever its width and wherever it stands to the cells, the edge leaves no ridge behind it.
TEST(no_ridge_stays_behind_the_edge) {
  DiggingProfile profile = digging("loam");
  profile.bucket.width_m = 1.37;
  for (const double swing_rad : {0.0, 0.4, 0.785, 2.0}) {
    BucketSoil soil(profile, 1, kStep_s);
    for (int n = 0; n <= 4000; ++n) {
      static_cast<void>(soil.step({7.0 - 2.5e-4 * n, -0.2, 1.4, swing_rad}));
    }
    for (double radius_m = 6.1; radius_m < 6.9; radius_m += 0.02) {
      for (double level_m = -0.6; level_m <= 0.6; level_m += 0.02) {
        const double x_m = radius_m * std::cos(swing_rad) - level_m * std::sin(swing_rad);
        const double y_m = radius_m * std::sin(swing_rad) + level_m * std::cos(swing_rad);
        assert_true(soil.ground().firm_m(x_m, y_m) < -0.19);
      }
    }
  }
}

/// Forces as the equation says, against the motion; none in the air, none of them with power over a
/// bucket that stands.
TEST(it_resists_motion_only) {
  BucketSoil soil(digging("loam"), 1, kStep_s);
  assert_near(soil.step({7.0, 0.5, 1.2, 0.0}).force_n.norm(), 0.0, 1e-9);
  drag(soil, 7.0, 6.8, -0.2, 1.2);
  const Eigen::Vector2d force_n = drag(soil, 6.8, 6.4, -0.2, 1.2);
  assert_true(force_n.x() > 2e3 && force_n.x() < 30e3);
  // Drawn back it is free at once: nothing pulls the bucket on.
  drag(soil, 6.4, 6.45, -0.2, 1.2);
  const Eigen::Vector2d back_n = drag(soil, 6.45, 6.5, -0.2, 1.2);
  assert_true(std::abs(back_n.x()) < 0.25 * force_n.x());
}

/// Deeper and stronger ground resists more.
TEST(depth_and_soil_tell) {
  const auto force_n = [](const char* name, double depth_m) {
    BucketSoil soil(digging(name), 1, kStep_s);
    static_cast<void>(soil.step({7.0, -depth_m, 1.2, 0.0}));
    return drag(soil, 7.0, 6.6, -depth_m, 1.2).x();
  };
  assert_true(force_n("loam", 0.3) > 1.5 * force_n("loam", 0.15));
  assert_true(force_n("loam", 0.2) > 1.5 * force_n("sand", 0.2));
  assert_true(force_n("clay", 0.3) > 1.1 * force_n("loam", 0.3));
}

/// A full bucket takes no more; tipped, it empties onto a heap that lies at its angle of repose.
TEST(it_fills_and_dumps) {
  BucketSoil soil(digging("sand"), 1, kStep_s);
  static_cast<void>(soil.step({8.0, -0.3, 1.2, 0.0}));
  drag(soil, 8.0, 4.5, -0.3, 1.2);
  assert_near(soil.fill_m3(), soil.profile().bucket.capacity_m3, 0.02);
  const double carried_kg = soil.fill_kg();
  assert_near(carried_kg, soil.fill_m3() * 1600.0 / 1.12, 1.0);
  // Curled in and lifted it keeps what it has and weighs that; then it turns out, to the side.
  BucketForce lifted;
  for (int n = 0; n < 10000; ++n) {
    lifted = soil.step({5.0, 2.0, 0.2, 1.5});
  }
  assert_near(soil.fill_kg(), carried_kg, 1.0);
  assert_near(lifted.force_n.x(), 0.0, 1e-6);
  assert_near(lifted.force_n.y(), 0.0, 1e-6);
  const LinkBody fill = soil.fill();
  assert_near(fill.mass_kg, carried_kg, 1.0);
  const double length_m = soil.profile().pin_m;
  assert_true(fill.mass_centre_m.x() > 0.4 * length_m && fill.mass_centre_m.x() < 0.7 * length_m &&
              fill.mass_centre_m.y() > 0.0 && fill.mass_centre_m.y() < 0.4 * length_m);
  assert_true(fill.inertia_kgm2 > 0.0);
  const double before_m3 = soil.ground().loose_m3();
  for (int n = 0; n < 30000; ++n) {
    static_cast<void>(soil.step({5.0, 2.0, 1.9, 1.5}));
  }
  assert_near(soil.fill_m3(), 0.0, 0.01);
  assert_near(soil.ground().loose_m3() - before_m3, carried_kg * 1.12 / 1600.0, 0.01);
  // No slope of the heap is much steeper than sand lies.
  double steepest = 0.0;
  for (double y_m = 4.0; y_m < 6.0; y_m += 0.1) {
    const double rise_m =
        soil.ground().height_m(0.35, y_m + 0.1) - soil.ground().height_m(0.35, y_m);
    steepest = std::max(steepest, std::abs(rise_m) / 0.1);
  }
  assert_true(steepest > 0.3 && steepest < 1.3 * std::tan(soil.profile().soil.repose_rad));
}

/// A wall of loam stands, one of sand falls in.
TEST(walls_stand_by_cohesion) {
  assert_true(standing_height_m(*soil_kind("loam"), kGravity) > 1.0);
  assert_true(standing_height_m(*soil_kind("sand"), kGravity) < 0.3);
  const auto beside_m = [](const char* name) {
    HeightField field(*soil_kind(name), 3.0, kGravity);
    for (double x_m = -1.0; x_m < 1.0; x_m += 0.5 * HeightField::kCell_m) {
      for (double y_m = -0.5; y_m < 0.5; y_m += 0.5 * HeightField::kCell_m) {
        static_cast<void>(field.cut(x_m, y_m, -1.0));
      }
    }
    repeat(400, [&] { field.settle(0.0, 0.0, 2.5); });
    return field.height_m(0.0, 0.6);
  };
  assert_near(beside_m("loam"), 0.0, 0.01);
  assert_true(beside_m("sand") < -0.2);
}

/// Pressed down flat, the floor comes to rest on the ground; the ground bears, then gives way.
TEST(the_floor_bears) {
  const DiggingProfile profile = digging("loam");
  BucketSoil soil(profile, 1, kStep_s);
  const double flat_rad = profile.bucket.floor_rad;
  static_cast<void>(soil.step({6.0, 0.05, flat_rad, 0.0}));
  static_cast<void>(soil.step({6.0, 0.0, flat_rad, 0.0}));
  const BucketForce light = soil.step({6.0, -0.002, flat_rad, 0.0});
  assert_true(light.force_n.y() > 10e3);
  for (int n = 1; n <= 500; ++n) {
    static_cast<void>(soil.step({6.0, -0.002 - 1e-4 * n, flat_rad, 0.0}));
  }
  const double most_n = soil.step({6.0, -0.052, flat_rad, 0.0}).force_n.y();
  const double bears_n = profile.bucket.width_m * profile.bucket.floor_m *
                         bearing_pa(profile.soil, profile.bucket.floor_m / 5.0, 0.0, kGravity);
  assert_true(most_n > 0.8 * bears_n && most_n < 1.3 * bears_n);
}
