// SPDX-License-Identifier: Apache-2.0
// Motor and platform on the machine: inertia, speed, ringing, braking, what turning does to the
// links.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "app/plant/excavator_plant.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/plant/fixture/machines.hpp"

using namespace graben::plant;

using AxisArray = ExcavatorPlant::AxisArray;
using DriveArray = ExcavatorPlant::DriveArray;

constexpr AxisArray kStart{0.45, 0.5, 0.4};
constexpr double kPi = 3.141592653589793;
constexpr double kDisplacement = 1.2e-3;

DriveArray swing_duty(double duty) { return {0.0, 0.0, 0.0, duty}; }

void run(ExcavatorPlant& plant, const DriveArray& duty, TimeUs duration_us) {
  plant.set_duty(duty, true);
  plant.advance(duration_us);
}

/// A mass centre from the boom foot, and which way its link points.
struct Centre {
  double mass_kg;
  double own_kgm2;
  double x_m;
  double y_m;
  double direction_rad;
};

std::vector<Centre> centres(const JointArray& q) {
  const double boom = q[0];
  const double arm = q[0] + q[1];
  const double bucket = arm + q[2];
  const auto centre = [](double mass, double own, double pin_x, double pin_y, double direction,
                         double x, double y) {
    return Centre{mass, own, pin_x + x * std::cos(direction) - y * std::sin(direction),
                  pin_y + x * std::sin(direction) + y * std::cos(direction), direction};
  };
  const double arm_x = 4.60 * std::cos(boom);
  const double arm_y = 4.60 * std::sin(boom);
  const double bucket_x = arm_x + 2.52 * std::cos(arm);
  const double bucket_y = arm_y + 2.52 * std::sin(arm);
  return {centre(992.0, 2080.0, 0.0, 0.0, boom, 2.22, 0.28),
          centre(392.0, 378.0, arm_x, arm_y, arm, 0.65, 0.09),
          centre(386.0, 78.5, bucket_x, bucket_y, bucket, 0.51, 0.205)};
}

double inertia_by_hand(const JointArray& q) {
  double inertia = 15000.0;
  for (const Centre& c : centres(q)) {
    inertia += c.mass_kg * (0.14 + c.x_m) * (0.14 + c.x_m) +
               c.own_kgm2 * std::cos(c.direction_rad) * std::cos(c.direction_rad);
  }
  return inertia;
}

TEST(inertia_is_that_of_the_parts) {
  for (const AxisArray& strokes : {kStart, AxisArray{0.1, 1.0, 0.1}, AxisArray{0.9, 0.1, 0.8}}) {
    ExcavatorPlant plant(machine_12t(), strokes);
    const double by_hand = inertia_by_hand(plant.joint_angles_rad());
    assert_true(by_hand > 18000.0);
    assert_near(plant.swing_inertia_kgm2(), by_hand, 1e-6 * by_hand);
    run(plant, {0.6, -0.6, 0.5, 0.0}, kSecondUs);
    const double moved = inertia_by_hand(plant.joint_angles_rad());
    assert_true(std::fabs(moved - by_hand) > 50.0);
    assert_near(plant.swing_inertia_kgm2(), moved, 1e-6 * moved);
  }
}

// A mass that goes round at w pulls outwards with m r w^2, at its height over the boom foot; a thin
// rod that does not stand upright is pulled level.
TEST(turning_pulls_the_links_outwards) {
  constexpr double kRate = 1.4;
  LinkageDynamics links(machine_12t());
  const JointArray q{0.6, -1.3, -0.7};
  links.start(q, {});
  const JointArray at_rest = links.holding_forces();
  links.set_swing_rate(kRate);
  const JointArray turning = links.holding_forces();
  const auto all = centres(q);
  const std::array<double, 3> pin_y{0.0, 4.60 * std::sin(0.6),
                                    4.60 * std::sin(0.6) + 2.52 * std::sin(0.6 - 1.3)};
  for (std::size_t i = 0; i < 3; ++i) {
    double moment = 0.0;
    for (std::size_t j = i; j < 3; ++j) {
      const Centre& c = all[j];
      moment -= c.mass_kg * (0.14 + c.x_m) * kRate * kRate * (c.y_m - pin_y[i]);
      moment -= 0.5 * kRate * kRate * c.own_kgm2 * std::sin(2.0 * c.direction_rad);
    }
    const double held = (turning[i] - at_rest[i]) * links.levers()[i].stroke_per_angle_m;
    assert_true(std::fabs(moment) > 100.0);
    assert_near(held, -moment, 1e-6 * std::fabs(moment));
  }
}

TEST(teeth_are_where_the_swing_looks) {
  const ExcavatorPlant plant(machine_12t(), kStart, 0.7);
  assert_near(plant.swing_rad(), 0.7, 0.0);
  const graben::plant::TipPose tip = plant.tip();
  const TeethTruth teeth = plant.teeth();
  assert_near(std::hypot(teeth.position_m.x(), teeth.position_m.y()), 0.14 + tip.position_m.x(),
              1e-12);
  assert_near(std::atan2(teeth.position_m.y(), teeth.position_m.x()), 0.7, 1e-12);
  assert_near(teeth.position_m.z(), 1.424 + tip.position_m.y(), 1e-12);
  assert_near(teeth.attitude_rad, tip.attitude_rad, 0.0);
}

// At an even rate the pump's flow, less what goes through the bypass, goes through the motor, but
// for what leaks; the pressures carry the friction.
TEST(speed_is_flow_over_displacement) {
  for (const double duty : {0.6, -0.6, 0.9}) {
    ExcavatorPlant plant(machine_12t(), kStart);
    run(plant, swing_duty(duty), 12 * kSecondUs);
    const double rate = plant.swing_rate_radps();
    assert_true(rate * duty > 0.0);
    const auto [left, right] = plant.swing_pressures_pa();
    // The valve's pressures; from there to the motor each way 0.1 to 0.3 MPa of hose.
    const double leak = 2.5e-12 * std::fabs(left - right);
    assert_true((left - right) * duty > 0.0);
    const double flow = plant.section_flows()[kSwing].supply_out_m3ps;
    assert_near(flow, kDisplacement * std::fabs(rate) + leak, 2e-6);
    const PumpFlows& pump = plant.pump(0).flows();
    assert_near(flow, pump.line_in_m3ps - pump.bypass_m3ps, 2e-6);
    const double friction = 2000.0 + 700.0 * std::fabs(rate);
    assert_near(std::fabs(left - right) * kDisplacement, friction, 0.3e6 * 2.0 * kDisplacement);
    assert_near(plant.strokes_m()[kBoom], kStart[kBoom], 0.5e-3);
  }
}

// Left to itself on the oil that the spool shuts in: K = beta D^2 2 / V. Make-up fills what the
// first swings leave open, then nothing but the filter of the elements takes energy.
TEST(shut_in_it_rings_at_its_own_frequency) {
  ExcavatorPlantProfile profile = machine_12t();
  profile.platform.coulomb_nm = 0.0;
  profile.platform.viscous_nmsprad = 0.0;
  profile.swing_motor.leak_m3pspa = 0.0;
  for (const double volume : {1.5e-3, 3.0e-3}) {
    profile.swing_motor.dead_volume_m3 = volume;
    ExcavatorPlant plant(profile, kStart);
    run(plant, swing_duty(0.5), 2 * kSecondUs);
    run(plant, {}, 10 * kSecondUs);
    std::vector<double> crossings_s;
    double before = plant.swing_rate_radps();
    double largest = 0.0;
    for (int i = 1; i <= 10000; ++i) {
      plant.advance(kMillisecondUs);
      const double rate = plant.swing_rate_radps();
      if (before < 0.0 && rate >= 0.0) {
        crossings_s.push_back(1e-3 * (i - rate / (rate - before)));
      }
      largest = std::max(largest, std::fabs(rate));
      before = rate;
    }
    assert_true(crossings_s.size() > 4 && largest > 0.01);
    const double period =
        (crossings_s.back() - crossings_s.front()) / static_cast<double>(crossings_s.size() - 1);
    const double stiffness = 1.4e9 * kDisplacement * kDisplacement * 2.0 / volume;
    const double expected =
        2.0 * kPi * std::sqrt(inertia_by_hand(plant.joint_angles_rad()) / stiffness);
    std::printf("period %.4f s, by formula %.4f s\n", period, expected);
    assert_near(period, expected, 0.01 * expected);
  }
}

// Full speed, then the spool shuts: the reliefs brake it evenly. What stands against it is the
// relief's pressure and friction.
TEST(braking_is_what_the_reliefs_hold) {
  for (const double side : {1.0, -1.0}) {
    ExcavatorPlant plant(machine_12t(), kStart);
    run(plant, swing_duty(side), 12 * kSecondUs);
    const double full = std::fabs(plant.swing_rate_radps());
    assert_true(full > 1.0);
    plant.set_duty({}, true);
    double highest = 0.0;
    double farthest = side * plant.swing_rad();
    double stopped_s = 0.0;
    for (int i = 0; i < 8000; ++i) {
      plant.advance(kMillisecondUs);
      const auto [left, right] = plant.swing_pressures_pa();
      highest = std::max({highest, left, right});
      farthest = std::max(farthest, side * plant.swing_rad());
      if (stopped_s == 0.0 && side * plant.swing_rate_radps() <= 0.0) {
        stopped_s = 1e-3 * i;
      }
    }
    const double back = farthest - side * plant.swing_rad();
    const double evenly_s = plant.swing_inertia_kgm2() * full / (kDisplacement * 35e6 + 2000.0);
    std::printf("from %.3f rad/s in %.2f s (evenly %.2f), at most %.2f MPa, back by %.4f rad\n",
                full, stopped_s, evenly_s, 1e-6 * highest, back);
    assert_true(highest > 35.0e6 && highest < 36.5e6);
    assert_true(stopped_s > 0.9 * evenly_s && stopped_s < 1.4 * evenly_s + 0.2);
    assert_true(back > 0.0 && back < 0.03);
    assert_near(plant.swing_rate_radps(), 0.0, 1e-9);
    assert_near(plant.peak_chamber_pressure_pa(), highest, 0.5e6);
  }
}

TEST(platform_keeps_its_momentum_and_sticks) {
  Platform free({10000.0, 0.0, 0.0}, 0.0, 5000.0);
  for (int i = 0; i < 1000; ++i) {
    static_cast<void>(free.accelerate({30000.0, 0.0}, 5000.0, 2e-4));
  }
  assert_near(free.rate_radps(), 30000.0 * 0.2 / 15000.0, 2e-3 * 0.4);
  for (int i = 0; i < 5000; ++i) {
    static_cast<void>(free.accelerate({}, 5000.0 + 4.0 * std::min(i, 4000), 2e-4));
  }
  assert_near(free.rate_radps() * 31000.0, 6000.0, 1e-6);
  assert_near(free.inertia_kgm2(), 31000.0, 0.0);
  assert_near(free.energy_j(), 0.5 * 6000.0 * 6000.0 / 31000.0, 1e-3);

  Platform stuck({10000.0, 500.0, 0.0}, 0.3, 0.0);
  for (int i = 0; i < 100; ++i) {
    assert_near(stuck.accelerate({499.0, 0.0}, 0.0, 2e-4), 0.0, 0.0);
    stuck.move(2e-4);
  }
  assert_near(stuck.angle_rad(), 0.3, 0.0);
  assert_near(stuck.friction_nm(), -499.0, 1e-9);
  static_cast<void>(stuck.accelerate({1500.0, 0.0}, 0.0, 2e-4));
  assert_near(stuck.friction_nm(), -500.0, 1e-9);
  assert_true(stuck.rate_radps() > 0.0);
}

// Both ways, with the boom going up and down in between, into the reliefs, until it stands.
TEST(energy_is_accounted_for) {
  for (const double coupled : {0.0, 1.0}) {
    ExcavatorPlantProfile profile = machine_12t();
    profile.swash_ratio = {1.0, 1.0};
    profile.swing_motor.leak_m3pspa = 1e-11;
    ExcavatorPlant plant(profile, kStart);
    EnergyAccount account;
    plant.keep_account(&account);
    const double before = plant.stored_energy_j();
    double largest = 0.0;
    double turning = 0.0;
    for (int i = 0; i < 2400; ++i) {
      const double t = 0.01 * i;
      const double boom = coupled * 0.7 * std::sin(1.3 * t);
      const double arm = coupled * 0.6 * std::sin(0.9 * t + 1.0);
      const double swing = t < 6.0 ? 0.9 : t < 10.0 ? -0.9 : t < 14.0 ? 0.0 : std::sin(0.8 * t);
      plant.set_duty({boom, arm, 0.0, t > 22.0 ? 0.0 : swing}, true);
      plant.advance(10 * kMillisecondUs);
      turning = std::max(turning, 0.5 * plant.swing_inertia_kgm2() * plant.swing_rate_radps() *
                                      plant.swing_rate_radps());
      const double rest = account.in_j() - account.lost_j() - (plant.stored_energy_j() - before);
      largest = std::max(largest, std::fabs(rest));
    }
    std::printf(
        "pump %.0f J, turning %.0f J, port relief %.0f, friction %.0f, leak %.0f, "
        "open at most %.1f J\n",
        account.pump_j, turning, account.port_relief_j, account.friction_j, account.piston_leak_j,
        largest);
    assert_true(turning > 10e3 && account.port_relief_j > 10e3 && account.piston_leak_j > 2e3);
    assert_near(largest / turning, 0.0, 5e-4);
    assert_near(largest / account.pump_j, 0.0, 2e-4);
  }
}

TEST(pilot_of_the_swing_is_as_the_others) {
  ExcavatorPlantProfile profile = machine_12t();
  profile.dead_time = {0.0, 0.0, 0.0, 0.1};
  ExcavatorPlant plant(profile, kStart);
  run(plant, {0.1, 0.0, 0.0, 0.1}, 90 * kMillisecondUs);
  assert_near(plant.swing_spool_ratio(), 0.0, 0.0);
  assert_true(plant.spool_travels_ratio()[kBoom] > 0.05);
  run(plant, {0.1, 0.0, 0.0, 0.1}, kSecondUs);
  assert_near(plant.swing_spool_ratio(), 0.1, 1e-6);
  plant.set_pilot_fault(kSwing, std::nullopt, 0.05);
  plant.advance(kSecondUs);
  assert_near(plant.swing_spool_ratio(), 0.15, 1e-6);
  plant.set_pilot_fault(kSwing, -0.12, 0.0);
  plant.advance(kSecondUs);
  assert_near(plant.swing_spool_ratio(), -0.12, 1e-6);
  plant.set_pilot_cut(true);
  plant.advance(kSecondUs);
  assert_near(plant.swing_spool_ratio(), 0.0, 1e-6);
  assert_near(plant.swing_rad(), 0.0, 0.0);  // all within the deadband: it sticks
}

// The bypass chain is that of four sections: one of them shut takes the flow from the tank.
TEST(swing_shuts_the_bypass_of_its_pump) {
  ExcavatorPlant plant(machine_12t(), kStart);
  const double standby = plant.pump_pressures_pa()[0];
  const double k = 1.0 / std::sqrt(5.0 / (5.8e-6 * 5.8e-6) + 1.0 / (5.1e-6 * 5.1e-6));
  assert_near(plant.pump_flows_m3ps()[0], k * std::sqrt(standby), 1e-7);
  run(plant, swing_duty(0.199), 500 * kMillisecondUs);
  assert_true(plant.pump_pressures_pa()[0] > 3.0 * standby);
}

TEST(without_the_drive_the_swing_is_held) {
  ExcavatorPlant plain(machine_22t(), {0.7, 0.7, 0.6}, 0.4);
  ExcavatorPlant told(machine_22t(), {0.7, 0.7, 0.6}, 0.4);
  run(plain, {0.6, -0.5, 0.4, 0.0}, 2 * kSecondUs);
  run(told, {0.6, -0.5, 0.4, 1.0}, 2 * kSecondUs);
  assert_true(plain.strokes_m() == told.strokes_m());
  assert_true(plain.pump_pressures_pa() == told.pump_pressures_pa());
  // What stands where its section would be is not looked at, not even as a port of a pump's line.
  ExcavatorPlantProfile profile = machine_22t();
  profile.machine.valve.spool[kSwing] = profile.machine.valve.spool[kArm];
  profile.machine.valve.spool[kSwing].pump = 1;
  ExcavatorPlant other(profile, {0.7, 0.7, 0.6}, 0.4);
  run(other, {0.6, -0.5, 0.4, 1.0}, 2 * kSecondUs);
  assert_true(plain.strokes_m() == other.strokes_m());
  assert_true(plain.pump_pressures_pa() == other.pump_pressures_pa());
  assert_near(told.swing_rad(), 0.4, 0.0);
  assert_near(told.swing_rate_radps() + told.swing_spool_ratio() + told.swing_inertia_kgm2(), 0.0,
              0.0);
  assert_near(told.swing_pressures_pa()[0] + told.swing_pressures_pa()[1], 0.0, 0.0);
}
