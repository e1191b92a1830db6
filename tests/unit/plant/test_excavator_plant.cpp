// SPDX-License-Identifier: Apache-2.0
// The whole machine: equilibrium, flow balance, end stops, robustness, step independence.

#include "app/plant/excavator_plant.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <vector>

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/plant/fixture/machines.hpp"

using namespace graben::plant;

using AxisArray = ExcavatorPlant::AxisArray;
using DriveArray = ExcavatorPlant::DriveArray;

constexpr TimeUs kCycleUs = 10 * kMillisecondUs;
constexpr AxisArray kStart{0.7, 0.7, 0.6};
constexpr double kPi = 3.141592653589793;

void run(ExcavatorPlant& plant, const DriveArray& duty, TimeUs duration_us) {
  plant.set_duty(duty, true);
  plant.advance(duration_us);
}

double cap_area(const ExcavatorPlantProfile& profile, std::size_t axis) {
  const CylinderGeometry& c = profile.machine.geometry.cylinder[axis];
  return c.count * kPi / 4.0 * c.bore_m * c.bore_m;
}

double rod_area(const ExcavatorPlantProfile& profile, std::size_t axis) {
  const CylinderGeometry& c = profile.machine.geometry.cylinder[axis];
  return c.count * kPi / 4.0 * (c.bore_m * c.bore_m - c.rod_m * c.rod_m);
}

// Boom foot: the links' weights with their arms against the cylinder force with its arm, all from
// plain trigonometry on the reported joint angles.
TEST(start_pressures_balance_the_boom) {
  const ExcavatorPlantProfile profile = machine_22t();
  const ExcavatorPlant plant(profile, kStart);
  const JointArray q = plant.joint_angles_rad();
  const double boom = q[0];
  const double arm = q[0] + q[1];
  const double bucket = q[0] + q[1] + q[2];
  const auto reach = [&](std::size_t i, double direction) {
    const Eigen::Vector2d& c = profile.link[i].mass_centre_m;
    return c.x() * std::cos(direction) - c.y() * std::sin(direction);
  };
  const double arm_pin = 5.7 * std::cos(boom);
  const double bucket_pin = arm_pin + 2.9 * std::cos(arm);
  const double weight_moment =
      9.80665 * (profile.link[0].mass_kg * reach(0, boom) +
                 profile.link[1].mass_kg * (arm_pin + reach(1, arm)) +
                 profile.link[2].mass_kg * (bucket_pin + reach(2, bucket)));
  // Arm of the cylinder: twice the area of the triangle foot, base, eye over its length.
  const double base_x = 0.46;
  const double base_y = -0.63;
  const double eye_x = 2.33 * std::cos(boom) - 0.85 * std::sin(boom);
  const double eye_y = 2.33 * std::sin(boom) + 0.85 * std::cos(boom);
  const double length = std::hypot(eye_x - base_x, eye_y - base_y);
  const double lever = (base_x * eye_y - base_y * eye_x) / length;
  assert_near(length, 1.760 + kStart[kBoom], 1e-9);
  const double force = cap_area(profile, 0) * plant.cap_pressures_pa()[0] -
                       rod_area(profile, 0) * plant.rod_pressures_pa()[0];
  assert_near(force * lever, weight_moment, 1e-6 * weight_moment);
}

TEST(start_is_an_equilibrium) {
  ExcavatorPlantProfile profile = machine_22t();
  profile.friction = {};  // friction would hold what is not balanced
  profile.piston_leak_m3pspa = 0.0;
  ExcavatorPlant plant(profile, kStart);
  const auto cap = plant.cap_pressures_pa();
  const auto line = plant.pump_pressures_pa();
  run(plant, {}, kSecondUs);
  for (std::size_t i = 0; i < 3; ++i) {
    assert_near(plant.strokes_m()[i], kStart[i], 1e-9);
    assert_near(plant.cap_pressures_pa()[i], cap[i], 10.0);
  }
  for (std::size_t p = 0; p < 2; ++p) {
    assert_near(plant.pump_pressures_pa()[p], line[p], 10.0);
  }
}

TEST(pumps_start_in_standby) {
  const ExcavatorPlantProfile profile = machine_22t();
  const ExcavatorPlant plant(profile, kStart);
  for (std::size_t p = 0; p < 2; ++p) {
    const double pressure = plant.pump_pressures_pa()[p];
    const double flow = 119e-6 * 188.5 / (2.0 * kPi) * 0.643 - 4e-12 * pressure;
    assert_near(plant.pump_flows_m3ps()[p], flow, 1e-7);
    // Series of two or three equal orifices of 4.5e-6 and the tank orifice of 4e-6.
    const double spools = p == 0 ? 1.0 : 2.0;
    const double k = 1.0 / std::sqrt((1.0 + spools) / (4.5e-6 * 4.5e-6) + 1.0 / (4e-6 * 4e-6));
    assert_near(plant.pump_flows_m3ps()[p], k * std::sqrt(pressure), 1e-7);
  }
}

// With spools closed only the leakage moves the pistons: 2e-14 m^3/(s Pa) at 10 MPa behind 0.0226
// m^2 is 0.009 mm/s.
TEST(held_machine_stays) {
  ExcavatorPlant plant(machine_22t(), kStart);
  plant.advance(5 * kSecondUs);
  for (std::size_t i = 0; i < 3; ++i) {
    assert_near(plant.strokes_m()[i], kStart[i], 0.1e-3);
  }
}

TEST(deadband_moves_nothing) {
  ExcavatorPlant plant(machine_22t(), kStart);
  run(plant, {0.19, -0.19, 0.19}, 2 * kSecondUs);
  for (std::size_t i = 0; i < 3; ++i) {
    assert_near(plant.strokes_m()[i], kStart[i], 0.1e-3);
  }
  assert_near(plant.spool_travels_ratio()[1], -0.19, 1e-6);
}

// Mean cylinder velocity of one second against the flow that its pump can give, the closed bypass
// taken off.
TEST(motion_follows_the_flow_balance) {
  const ExcavatorPlantProfile profile = machine_22t();
  struct Case {
    std::size_t axis;
    double duty;
    double k_closed;
    double other_spools;
  };
  for (const Case& c : {Case{kBoom, 0.9, 5.6e-7, 1.0}, Case{kArm, -0.9, 4e-7, 0.0},
                        Case{kBucket, 0.8, 5.6e-7, 1.0}}) {
    ExcavatorPlant plant(profile, {0.4, 1.2, 0.2});
    DriveArray duty{};
    duty[c.axis] = c.duty;
    run(plant, duty, kSecondUs);
    const double before = plant.strokes_m()[c.axis];
    const std::size_t pump = c.axis == kArm ? 0 : 1;
    double bypassed = 0.0;
    double delivered = 0.0;
    for (int i = 0; i < 100; ++i) {
      plant.advance(kCycleUs);
      const double pressure = plant.pump_pressures_pa()[pump];
      const double k =
          1.0 / std::sqrt(1.0 / (c.k_closed * c.k_closed) +
                          (1.0 + c.other_spools) / (4.5e-6 * 4.5e-6) + 1.0 / (4e-6 * 4e-6));
      bypassed += 0.01 * k * std::sqrt(pressure);
      delivered += 0.01 * plant.pump_flows_m3ps()[pump];
    }
    const double moved = plant.strokes_m()[c.axis] - before;
    const double area = c.duty > 0.0 ? cap_area(profile, c.axis) : rod_area(profile, c.axis);
    assert_true(moved * c.duty > 0.0);
    assert_near(std::fabs(moved) * area / (delivered - bypassed), 1.0, 0.03);
  }
}

TEST(disabled_and_not_finite_duties_are_neutral) {
  ExcavatorPlant plant(machine_22t(), kStart);
  plant.set_duty({1.0, 1.0, 1.0}, false);
  plant.advance(kSecondUs);
  assert_near(plant.spool_travels_ratio()[0], 0.0, 0.0);
  run(plant, {0.0, std::nan(""), std::numeric_limits<double>::infinity()}, kSecondUs);
  for (std::size_t i = 0; i < 3; ++i) {
    assert_near(plant.spool_travels_ratio()[i], 0.0, 0.0);
    assert_near(plant.strokes_m()[i], kStart[i], 0.1e-3);
  }
}

TEST(tip_force_reaches_the_chambers) {
  ExcavatorPlant plant(machine_22t(), kStart);
  const double before = plant.cap_pressures_pa()[kBoom];
  plant.set_tip_force({0.0, -10e3});
  plant.advance(2 * kSecondUs);
  assert_true(plant.cap_pressures_pa()[kBoom] > before + 1e6);
}

struct Extremes {
  double void_m3 = 0.0;
  double highest_pa = 0.0;
  double overrun_m = 0.0;
  double fastest_mps = 0.0;
};

// Fails on the first number that is not finite.
void watch(const ExcavatorPlant& plant, Extremes& extremes) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (const double pressure : {plant.cap_pressures_pa()[i], plant.rod_pressures_pa()[i]}) {
      assert_true(std::isfinite(pressure));
      extremes.highest_pa = std::max(extremes.highest_pa, pressure);
    }
    const Cylinder& cylinder = plant.cylinder(i);
    extremes.void_m3 =
        std::max({extremes.void_m3, cylinder.cap().void_m3(), cylinder.rod().void_m3()});
    const double stroke = plant.strokes_m()[i];
    const double full = plant.profile().machine.geometry.cylinder[i].stroke_m;
    assert_true(std::isfinite(stroke));
    extremes.overrun_m = std::max({extremes.overrun_m, -stroke, stroke - full});
    extremes.fastest_mps =
        std::max(extremes.fastest_mps, std::fabs(plant.stroke_velocities_mps()[i]));
  }
  for (const double pressure : plant.pump_pressures_pa()) {
    assert_true(std::isfinite(pressure));
    extremes.highest_pa = std::max(extremes.highest_pa, pressure);
  }
}

TEST(full_speed_into_the_end_stops) {
  for (const double bulk_modulus : {1.4e9, 1.0e10}) {
    ExcavatorPlantProfile profile = machine_22t();
    profile.bulk_modulus_pa = bulk_modulus;
    profile.swash_ratio = {1.0, 1.0};
    ExcavatorPlant plant(profile, kStart);
    Extremes extremes;
    for (const DriveArray& duty : {DriveArray{1.0, 1.0, 1.0}, DriveArray{-1.0, -1.0, -1.0},
                                   DriveArray{1.0, 0.0, 0.0}, DriveArray{-1.0, 0.0, 0.0}}) {
      for (int i = 0; i < 2000; ++i) {
        run(plant, duty, kCycleUs);
        watch(plant, extremes);
      }
      assert_near(plant.stroke_velocities_mps()[kBoom], 0.0, 1e-3);
    }
    assert_true(extremes.overrun_m > 0.0);  // they were reached
    assert_true(extremes.overrun_m < 1e-3);
    assert_true(extremes.void_m3 < 1e-6);  // the make-up checks see to it
    assert_true(extremes.highest_pa < 1.1 * profile.port_relief_pa);
  }
}

TEST(random_duty_for_a_minute) {
  for (const double bulk_modulus : {1.4e9, 1.0e10}) {
    ExcavatorPlantProfile profile = machine_22t();
    profile.bulk_modulus_pa = bulk_modulus;
    ExcavatorPlant plant(profile, kStart);
    std::mt19937 generator(7);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    Extremes extremes;
    DriveArray duty{};
    for (int i = 0; i < 6000; ++i) {
      if (i % 7 == 0) {
        duty = {any(generator), any(generator), any(generator)};
      }
      run(plant, duty, kCycleUs);
      watch(plant, extremes);
    }
    assert_true(extremes.fastest_mps > 0.1);
    assert_true(extremes.fastest_mps < 2.0);
    assert_true(extremes.overrun_m < 1e-3);
    assert_true(extremes.void_m3 < 1e-6);  // the make-up checks see to it
    assert_true(extremes.highest_pa < 1.1 * profile.port_relief_pa);
  }
}

// Five seconds of spool steps on all axes, both ways, several at a time.
std::vector<AxisArray> spool_steps(ExcavatorPlantProfile profile, TimeUs step_us) {
  profile.step_us = step_us;
  ExcavatorPlant plant(profile, kStart);
  std::vector<AxisArray> strokes;
  for (int i = 0; i < 500; ++i) {
    const double t = 0.01 * i;
    DriveArray duty{};
    duty[kBoom] = t < 0.2 ? 0.0 : t < 1.8 ? 0.5 : t < 2.2 ? 0.0 : t < 3.6 ? -0.45 : 0.3;
    duty[kArm] = t < 0.4 ? 0.0 : t < 2.2 ? 0.6 : t < 3.2 ? -0.6 : t < 4.4 ? 0.3 : 0.0;
    duty[kBucket] = t < 1.0 ? 0.0 : t < 1.8 ? -0.5 : t < 3.2 ? 0.5 : t < 4.0 ? 0.0 : 0.3;
    run(plant, duty, kCycleUs);
    strokes.push_back(plant.strokes_m());
  }
  return strokes;
}

double largest_difference(const std::vector<AxisArray>& a, const std::vector<AxisArray>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      largest = std::max(largest, std::fabs(a[i][axis] - b[i][axis]));
    }
  }
  return largest;
}

double largest_tip_difference(const ExcavatorPlantProfile& profile, const std::vector<AxisArray>& a,
                              const std::vector<AxisArray>& b) {
  const LinkageGeometry geometry(profile.machine.geometry);
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); i += 10) {
    const Eigen::Vector2d tip_a = geometry.tip(geometry.angles_at(a[i])).position_m;
    const Eigen::Vector2d tip_b = geometry.tip(geometry.angles_at(b[i])).position_m;
    largest = std::max(largest, (tip_a - tip_b).norm());
  }
  return largest;
}

TEST(half_the_step_gives_the_same_path) {
  for (const double bulk_modulus : {1.4e9, 1.0e10}) {
    ExcavatorPlantProfile profile = machine_22t();
    profile.bulk_modulus_pa = bulk_modulus;
    const std::vector<AxisArray> full = spool_steps(profile, 200);
    assert_true(largest_difference(full, {full.size(), kStart}) > 0.1);
    const std::vector<AxisArray> half = spool_steps(profile, 100);
    const double tip = largest_tip_difference(profile, full, half);
    std::printf("%.1f GPa: half the step moves strokes by %.4f mm and the tip by %.4f mm\n",
                1e-9 * bulk_modulus, 1e3 * largest_difference(full, half), 1e3 * tip);
    assert_near(largest_difference(full, half), 0.0, 0.02e-3);
    assert_near(tip, 0.0, 0.1e-3);
    assert_near(largest_difference(full, spool_steps(profile, 20)), 0.0, 0.05e-3);
  }
}

TEST(same_calls_same_numbers) {
  const std::vector<AxisArray> first = spool_steps(machine_22t(), 200);
  const std::vector<AxisArray> second = spool_steps(machine_22t(), 200);
  assert_near(largest_difference(first, second), 0.0, 0.0);
}

TEST(shares_of_a_step_are_kept) {
  ExcavatorPlant whole(machine_22t(), kStart);
  ExcavatorPlant pieces(machine_22t(), kStart);
  run(whole, {0.6, 0.0, 0.0}, 300 * kMillisecondUs);
  pieces.set_duty({0.6, 0.0, 0.0}, true);
  repeat(3000, [&] { pieces.advance(100); });
  assert_near(pieces.strokes_m()[kBoom], whole.strokes_m()[kBoom], 0.0);
}

// All three axes on the one pump of the 12 t machine, one after the other and together; the second
// line stays out of it.
TEST(one_pump_feeds_all) {
  const ExcavatorPlantProfile profile =
      machines::load_simulated_excavator(machines::find_profile("excavator_12t")).plant;
  ExcavatorPlant plant(profile, {0.4, 0.5, 0.4});
  const AxisArray before = plant.strokes_m();
  for (const DriveArray& duty :
       {DriveArray{0.6, 0.0, 0.0}, {0.0, 0.6, 0.0}, {0.0, 0.0, 0.6}, {0.5, 0.5, 0.5}}) {
    run(plant, duty, 500 * kMillisecondUs);
    assert_true(plant.pump_pressures_pa()[0] > 1e5);
    assert_near(plant.pump_pressures_pa()[1], 0.0, 0.0);
    assert_near(plant.pump_flows_m3ps()[1], 0.0, 0.0);
  }
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    assert_true(plant.strokes_m()[i] > before[i] + 0.02);
  }
}
