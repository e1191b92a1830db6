// SPDX-License-Identifier: Apache-2.0
// Geometry and rigid-body dynamics of the links, without oil.

#include "app/plant/linkage_dynamics.hpp"
#include "app/plant/linkage_geometry.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/plant/fixture/machines.hpp"

using namespace graben::plant;

constexpr double kPi = 3.141592653589793;
constexpr double kStep = 2e-4;
constexpr JointArray kPose{0.3, -1.2, -0.9};
const std::array<PistonLoad, kAxisCount> kNoLoad{};

JointArray strokes(const LinkageGeometry& geometry, const JointArray& angle) {
  const auto lever = geometry.levers(rotations_of(angle));
  return {lever[0].stroke_m, lever[1].stroke_m, lever[2].stroke_m};
}

TEST(little_rotations_are_exact) {
  for (const double angle : {-0.01, -3e-4, 0.0, 1e-7, 2e-3, 0.01}) {
    const Rotation little = Rotation::by_little(angle);
    assert_near(little.cosine, std::cos(angle), 2e-15);
    assert_near(little.sine, std::sin(angle), 2e-15);
  }
}

// The ends of the machine file's angle ranges.
TEST(strokes_span_the_angle_ranges) {
  const LinkageGeometry geometry(machine_22t().machine.geometry);
  const JointArray low = strokes(geometry, {-0.960, -0.436, 0.52});
  const JointArray high = strokes(geometry, {0.942, -2.618, -2.79});
  assert_near(low[kBoom], 0.0, 0.003);
  assert_near(high[kBoom], 1.26, 0.003);
  assert_near(low[kArm], 0.0, 0.003);
  assert_near(high[kArm], 1.504, 0.003);
  assert_near(low[kBucket], 0.0, 0.003);
  assert_near(high[kBucket], 1.11, 0.006);
}

TEST(bucket_stroke_falls_with_its_angle) {
  const LinkageGeometry geometry(machine_22t().machine.geometry);
  for (int i = 0; i <= 331; ++i) {
    const double angle = -2.79 + 0.01 * i;
    assert_true(geometry.levers(rotations_of({0.0, 0.0, angle}))[kBucket].stroke_per_angle_m < 0.0);
  }
}

TEST(levers_are_the_slopes_of_the_strokes) {
  const LinkageGeometry geometry(machine_22t().machine.geometry);
  for (int k = 0; k <= 14; ++k) {
    const double share = 0.02 + 0.068 * k;
    const JointArray angle{-0.96 + 1.90 * share, -0.44 - 2.17 * share, 0.51 - 3.29 * share};
    const auto lever = geometry.levers(rotations_of(angle));
    for (std::size_t i = 0; i < 3; ++i) {
      JointArray more = angle;
      JointArray less = angle;
      more[i] += 1e-6;
      less[i] -= 1e-6;
      const double slope = (strokes(geometry, more)[i] - strokes(geometry, less)[i]) / 2e-6;
      assert_near(lever[i].stroke_per_angle_m, slope, 1e-7);
    }
  }
}

TEST(angles_reproduce_the_strokes) {
  const ExcavatorPlantProfile profile = machine_22t();
  const LinkageGeometry geometry(profile.machine.geometry);
  for (int k = 0; k <= 20; ++k) {
    const double share = 0.05 * k;
    JointArray wanted{};
    for (std::size_t i = 0; i < 3; ++i) {
      wanted[i] = share * profile.machine.geometry.cylinder[i].stroke_m;
    }
    const JointArray got = strokes(geometry, geometry.angles_at(wanted));
    for (std::size_t i = 0; i < 3; ++i) {
      assert_near(got[i], wanted[i], 1e-9);
    }
  }
}

TEST(tip_of_a_stretched_machine) {
  const LinkageGeometry geometry(machine_22t().machine.geometry);
  plant::TipPose tip = geometry.tip({0.0, 0.0, 0.0});
  assert_near(tip.position_m.x(), 5.7 + 2.9 + 1.5, 1e-12);
  assert_near(tip.position_m.y(), 0.0, 1e-12);
  assert_near(tip.attitude_rad, kPi, 1e-12);
  tip = geometry.tip({0.5 * kPi, -0.5 * kPi, -0.5 * kPi});
  assert_near(tip.position_m.x(), 2.9, 1e-12);
  assert_near(tip.position_m.y(), 5.7 - 1.5, 1e-12);
  assert_near(tip.attitude_rad, 0.5 * kPi, 1e-12);
}

// Work of a small turn of one joint against gravity, from the mass centres alone.
double lifting_moment(const ExcavatorPlantProfile& profile, const JointArray& angle,
                      std::size_t joint) {
  const auto potential = [&](const JointArray& q) {
    const std::array<double, 3> length{profile.machine.geometry.boom_length_m,
                                       profile.machine.geometry.arm_length_m, 0.0};
    double height = 0.0;
    double sum = 0.0;
    double direction = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      direction += q[i];
      const LinkBody& link = profile.link[i];
      sum += 9.80665 * link.mass_kg *
             (height + link.mass_centre_m.x() * std::sin(direction) +
              link.mass_centre_m.y() * std::cos(direction));
      height += length[i] * std::sin(direction);
    }
    return sum;
  };
  JointArray more = angle;
  JointArray less = angle;
  more[joint] += 1e-5;
  less[joint] -= 1e-5;
  return (potential(more) - potential(less)) / 2e-5;
}

TEST(holding_forces_balance_gravity) {
  const ExcavatorPlantProfile profile = machine_22t();
  LinkageDynamics links(profile);
  for (const JointArray& pose : {kPose, JointArray{-0.6, -2.2, 0.1}, JointArray{0.8, -0.6, -2.2}}) {
    links.start(pose, {});
    for (std::size_t i = 0; i < 3; ++i) {
      const double moment = links.holding_forces()[i] * links.levers()[i].stroke_per_angle_m;
      assert_near(moment, lifting_moment(profile, pose, i), 0.05);
    }
  }
}

TEST(tip_force_works_through_the_tip) {
  ExcavatorPlantProfile profile = machine_22t();
  profile.gravity_mps2 = 0.0;
  LinkageDynamics links(profile);
  const LinkageGeometry geometry(profile.machine.geometry);
  links.set_tip_force({30e3, -20e3}, 4e3);
  links.start(kPose, {});
  for (std::size_t i = 0; i < 3; ++i) {
    JointArray more = kPose;
    JointArray less = kPose;
    more[i] += 1e-6;
    less[i] -= 1e-6;
    const Eigen::Vector2d move =
        (geometry.tip(more).position_m - geometry.tip(less).position_m) / 2e-6;
    const double moment = links.holding_forces()[i] * links.levers()[i].stroke_per_angle_m;
    // A moment on the bucket turns with every joint that carries it.
    assert_near(moment, -(30e3 * move.x() - 20e3 * move.y() + 4e3), 0.5);
  }
}

// Released, the links swing freely, through more than a turn: a check of mass matrix, centrifugal
// terms and gravity together.
TEST(free_swing_keeps_its_energy) {
  LinkageDynamics links(machine_22t());
  links.start(kPose, {});
  const double start = links.energy_j();
  double lowest = start;
  double largest_error = 0.0;
  double fastest = 0.0;
  links.start({-0.5 * kPi, 0.0, 0.0}, {});
  const double exchange = start - links.energy_j();  // hanging straight down
  links.start(kPose, {});
  for (int i = 0; i < 50000; ++i) {
    links.accelerate(kNoLoad, kStep);
    links.move(kStep);
    largest_error = std::max(largest_error, std::fabs(links.energy_j() - start));
    fastest = std::max(fastest, std::fabs(links.rates()[2]));
    lowest = std::min(lowest, links.energy_j());
  }
  assert_true(exchange > 1e5);
  assert_true(fastest > 2.0);
  assert_near(largest_error / exchange, 0.0, 1e-3);
}

// What the bucket carries is part of it, in all that the links do: it weighs, and it is slow to
// move.
TEST(what_is_carried_moves_with_the_bucket) {
  ExcavatorPlantProfile loaded = machine_22t();
  const LinkBody fill = {1400.0, 300.0, {0.8, 0.3}};
  loaded.link[kBucket] = together(loaded.link[kBucket], fill);
  LinkageDynamics whole(loaded);
  LinkageDynamics carries(machine_22t());
  LinkageDynamics empty(machine_22t());
  for (LinkageDynamics* links : {&whole, &carries, &empty}) {
    links->start(kPose, {});
  }
  carries.carry(fill);
  const JointArray holding = whole.holding_forces();
  for (std::size_t i = 0; i < 3; ++i) {
    assert_near(carries.holding_forces()[i], holding[i], 1e-6 * std::fabs(holding[i]));
  }
  for (int n = 0; n < 2000; ++n) {
    for (LinkageDynamics* links : {&whole, &carries, &empty}) {
      links->accelerate(kNoLoad, kStep);
      links->move(kStep);
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    assert_near(carries.angles()[i], whole.angles()[i], 1e-9);
  }
  assert_true(std::fabs(carries.angles()[kBucket] - empty.angles()[kBucket]) > 1e-3);
  carries.carry({});
  empty.start(kPose, {});
  carries.start(kPose, {});
  assert_near(carries.holding_forces()[kBoom], empty.holding_forces()[kBoom], 1e-6);
}

TEST(single_body_swings_with_the_pendulum_period) {
  // Everything but the boom without mass; small swings about hanging down.
  ExcavatorPlantProfile profile = machine_22t();
  profile.link[kBoom] = {2000.0, 5000.0, {2.5, 0.0}};
  profile.link[kArm] = {1e-6, 1e-6, {0.0, 0.0}};
  profile.link[kBucket] = {1e-6, 1e-6, {0.0, 0.0}};
  LinkageDynamics links(profile);
  links.start({-0.5 * kPi + 0.01, 0.0, 0.0}, {});
  const double inertia = 5000.0 + 2000.0 * 2.5 * 2.5;
  const double half_period = kPi * std::sqrt(inertia / (2000.0 * 9.80665 * 2.5));
  double time = 0.0;
  do {
    links.accelerate(kNoLoad, kStep);
    links.move(kStep);
    time += kStep;
  } while (time < 0.5 || links.rates()[0] < 0.0);
  assert_near(time, half_period, 2e-3);
}

std::array<PistonLoad, kAxisCount> loads(const JointArray& force_n, double coulomb_n) {
  std::array<PistonLoad, kAxisCount> load;
  for (std::size_t i = 0; i < 3; ++i) {
    load[i] = {force_n[i], 0.0, coulomb_n};
  }
  return load;
}

TEST(friction_sticks_without_creep) {
  LinkageDynamics links(machine_22t());
  links.start(kPose, {});
  JointArray force = links.holding_forces();
  for (double& f : force) {
    f += 2500.0;
  }
  for (int i = 0; i < 5000; ++i) {
    links.accelerate(loads(force, 3000.0), kStep);
    links.move(kStep);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    assert_near(links.angles()[i], kPose[i], 1e-9);
  }
}

TEST(friction_slips_beyond_its_limit) {
  LinkageDynamics links(machine_22t());
  links.start(kPose, {});
  JointArray force = links.holding_forces();
  force[kBoom] += 6000.0;
  for (int i = 0; i < 50; ++i) {
    links.accelerate(loads(force, 3000.0), kStep);
    links.move(kStep);
  }
  assert_true(links.angles()[kBoom] > kPose[kBoom]);
}

TEST(friction_brakes_a_piston_to_rest) {
  ExcavatorPlantProfile profile = machine_22t();
  profile.gravity_mps2 = 0.0;
  LinkageDynamics links(profile);
  links.start(kPose, {0.2, -0.3, 0.1});
  double energy = links.energy_j();
  for (int i = 0; i < 25000; ++i) {
    links.accelerate(loads({}, 20e3), kStep);
    links.move(kStep);
    assert_true(links.energy_j() <= energy * (1.0 + 1e-6) + 1e-3);
    energy = links.energy_j();
  }
  assert_near(energy, 0.0, 1e-9);
}
