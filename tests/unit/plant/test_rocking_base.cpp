// SPDX-License-Identifier: Apache-2.0
// Ground that gives way: how far the machine rocks and sinks, how fast it swings, and that this is
// what the teeth and the IMUs do. By hand, from the bucket's pins and a spring.

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdio>

#include "app/plant/excavator_plant.hpp"
#include "app/plant/link_imus.hpp"
#include "app/runs/fence_truth.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/plant/fixture/machines.hpp"

using namespace graben::plant;

using AxisArray = ExcavatorPlant::AxisArray;

constexpr AxisArray kStart{0.7, 0.7, 0.6};
constexpr TimeUs kCycleUs = 10 * kMillisecondUs;
constexpr double kTold_rad = 0.026;
/// Of the full force: so little that no relief opens.
constexpr double kShare = 0.1;

/// Links that hardly give way, so that the base is seen alone.
ExcavatorPlantProfile soft_ground() {
  ExcavatorPlantProfile profile = machine_22t();
  profile.bulk_modulus_pa = 1e11;
  profile.rocking_rad = kTold_rad;
  return profile;
}

Eigen::Vector2d from_tracks_m(const ExcavatorPlant& plant) {
  return plant.profile().machine.geometry.boom_foot_m + plant.tip().position_m;
}

void run_for(ExcavatorPlant& plant, double time_s) {
  for (int i = 0; i < static_cast<int>(time_s / 0.01); ++i) {
    plant.advance(kCycleUs);
  }
}

TEST(it_rocks_as_far_as_it_is_told_under_its_bucket) {
  const ExcavatorPlantProfile profile = soft_ground();
  const ExcavatorGeometry& geometry = profile.machine.geometry;
  ExcavatorPlant plant(profile, kStart);
  ExcavatorPlantProfile firm_profile = profile;
  firm_profile.rocking_rad = 0.0;
  ExcavatorPlant firm(firm_profile, kStart);
  assert_null(firm.rocking());
  run_for(plant, 1.0);
  assert_near(plant.rocking()->angle_rad(), 0.0, 1e-4);
  // The moment of so much of the full force at the boom's end, by a force up where the teeth are.
  const double reach_m = geometry.boom_foot_m.x() + geometry.boom_length_m;
  const double force_n = kShare * full_bucket_force_n(profile) * reach_m / from_tracks_m(plant).x();
  for (ExcavatorPlant* each : {&plant, &firm}) {
    each->set_tip_force({0.0, force_n});
    run_for(*each, 10.0);
  }
  const double angle_rad = plant.rocking()->angle_rad();
  std::printf("full force %.0f N; rocks by %.5f rad, sinks by %.2f mm\n",
              full_bucket_force_n(profile), angle_rad, 1e3 * plant.rocking()->sunk_m());
  assert_near(angle_rad, kShare * kTold_rad, 0.03 * kShare * kTold_rad);
  // A pull up lifts the tracks too: by the same springs, 1.5 m to each side of the middle.
  const double up_npm = full_bucket_force_n(profile) * reach_m / kTold_rad / (1.5 * 1.5);
  assert_near(plant.rocking()->sunk_m(), -force_n / up_npm, 1e-5);
  // The teeth go up with it, as far as they are from the middle of the tracks.
  const double up_m = plant.teeth().position_m.z() - firm.teeth().position_m.z();
  assert_near(up_m, from_tracks_m(firm).x() * angle_rad - plant.rocking()->sunk_m(), 1.5e-3);
  assert_near(plant.tip().attitude_rad - firm.tip().attitude_rad, angle_rad, 3e-4);
  // The fences' truth and the teeth are one.
  graben::Fence level;
  level.normal = {0.0, 0.0, -1.0};
  level.guard = graben::FenceGuard::kTeeth;
  assert_near(graben::runs::FenceTruth(plant).left_m(level), plant.teeth().position_m.z(), 1e-9);
}

/// Of a spring with the body and the links on it, by hand: 4 times the links' mass 1.6 m from the
/// middle, and the links where they are, as one piece.
TEST(it_swings_with_body_and_links) {
  const ExcavatorPlantProfile profile = soft_ground();
  const ExcavatorGeometry& geometry = profile.machine.geometry;
  ExcavatorPlant plant(profile, kStart);
  const JointArray joint = plant.joint_angles_rad();
  const std::array<double, 3> length_m = {geometry.boom_length_m, geometry.arm_length_m,
                                          geometry.bucket_length_m};
  double links_kg = 0.0;
  double links_kgm2 = 0.0;
  double angle_rad = 0.0;
  Eigen::Vector2d pin_m = geometry.boom_foot_m;
  for (std::size_t i = 0; i < 3; ++i) {
    angle_rad += joint[i];
    const Eigen::Rotation2Dd turn(angle_rad);
    links_kg += profile.link[i].mass_kg;
    links_kgm2 +=
        profile.link[i].inertia_kgm2 +
        profile.link[i].mass_kg * (pin_m + turn * profile.link[i].mass_centre_m).squaredNorm();
    pin_m += turn * Eigen::Vector2d(length_m[i], 0.0);
  }
  const double reach_m = geometry.boom_foot_m.x() + geometry.boom_length_m;
  const double stiffness = full_bucket_force_n(profile) * reach_m / kTold_rad;
  const double by_hand_s =
      2.0 * std::acos(-1.0) * std::sqrt((4.0 * links_kg * 1.6 * 1.6 + links_kgm2) / stiffness);
  plant.set_tip_force({0.0, 10e3});
  run_for(plant, 5.0);
  plant.set_tip_force({0.0, 0.0});
  // Its fall through the rest, and the next one.
  std::array<double, 2> falls_s{};
  std::size_t count = 0;
  double before_rad = plant.rocking()->angle_rad();
  for (int i = 1; i < 20000 && count < 2; ++i) {
    plant.advance(200);
    const double now_rad = plant.rocking()->angle_rad();
    if (before_rad > 0.0 && now_rad <= 0.0) {
      falls_s[count++] = 200e-6 * i;
    }
    before_rad = now_rad;
  }
  assert_int_equal(count, 2);
  std::printf("swings in %.3f s, by hand %.3f s\n", falls_s[1] - falls_s[0], by_hand_s);
  assert_near((falls_s[1] - falls_s[0]) / by_hand_s, 1.0, 0.06);
}

TEST(imus_turn_with_it) {
  ExcavatorPlantProfile profile = soft_ground();
  for (ImuMount& mount : profile.machine.imu.mount) {
    mount.address = 1;
  }
  ExcavatorPlant plant(profile, kStart);
  LinkImuModel imus(profile, std::nullopt);
  plant.set_tip_force({0.0, 20e3});
  double boom_rad = 0.0;
  double body_rad = 0.0;
  for (int i = 0; i < 500; ++i) {
    plant.advance(kCycleUs);
    imus.look(plant);
    boom_rad += 0.01 * imus.rates(kBoom).pitch_rate_radps.value;
    body_rad += 0.01 * imus.rates(kBodyImu).pitch_rate_radps.value;
  }
  const auto force = imus.forces(kBodyImu);
  const double angle_rad = plant.rocking()->angle_rad();
  assert_true(angle_rad > 1e-3);
  assert_near(body_rad, angle_rad, 1e-4);
  assert_near(boom_rad, angle_rad, 3e-4);
  assert_near(std::atan2(force.longitudinal_mps2.value, force.vertical_mps2.value), angle_rad,
              1e-4);
}

/// A stroke's worth of boom makes its weight's moment another one: the ground follows that too.
TEST(weight_that_moves_rocks_it) {
  ExcavatorPlant plant(soft_ground(), kStart);
  plant.set_swash({1.0, 1.0});
  const double before_m = from_tracks_m(plant).x();
  for (int i = 0; i < 300; ++i) {
    plant.set_duty({0.0, i < 200 ? -0.7 : 0.0, 0.0, 0.0}, true);
    plant.advance(kCycleUs);
  }
  run_for(plant, 2.0);
  assert_true(from_tracks_m(plant).x() > before_m + 0.5);
  assert_true(plant.rocking()->angle_rad() < -1e-4);
}
