// SPDX-License-Identifier: Apache-2.0
// What must balance whatever the machine does: energy, oil, and gravity against the cylinders.

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/plant/excavator_plant.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/plant/fixture/machines.hpp"

using namespace graben::plant;

using AxisArray = ExcavatorPlant::AxisArray;

constexpr AxisArray kStart{0.7, 0.7, 0.6};
constexpr TimeUs kCycleUs = 10 * kMillisecondUs;

// 30 s on all axes, both ways, into the end stops and the pumps' reliefs, with shut spools through
// the port reliefs; at rest in the end.
void drive(ExcavatorPlant& plant, int cycle) {
  const double t = 0.01 * cycle;
  const bool pressed = t > 14.0 && t < 15.0;
  const double lift = t < 4.0 ? 1.0 : 0.0;
  plant.set_tip_force(pressed ? Eigen::Vector2d(-60e3, -100e3)
                              : Eigen::Vector2d(lift * 15e3, lift * 8e3));
  if (t > 28.0 || (t > 13.5 && t < 15.5)) {
    plant.set_duty({}, true);
  } else if (t > 20.0) {
    const double all = t < 24.0 ? 1.0 : -1.0;
    plant.set_duty({all, all, all}, true);
  } else {
    plant.set_duty(
        {0.6 * std::sin(0.9 * t) + 0.1 * std::sin(5.0 * t),
         0.65 * std::sin(0.7 * t + 1.0) + 0.1 * std::sin(4.0 * t), 0.6 * std::sin(1.1 * t + 2.0)},
        true);
  }
}

TEST(energy_is_accounted_for) {
  for (const double bulk_modulus : {1.4e9, 1.0e10}) {
    ExcavatorPlantProfile profile = machine_22t();
    profile.bulk_modulus_pa = bulk_modulus;
    profile.swash_ratio = {1.0, 1.0};
    profile.piston_leak_m3pspa = 2e-12;  // a worn seal, so that its loss counts
    ExcavatorPlant plant(profile, kStart);
    EnergyAccount account;
    plant.keep_account(&account);
    const double before = plant.stored_energy_j();
    double largest = 0.0;
    double regenerated = 0.0;
    for (int i = 0; i < 3000; ++i) {
      drive(plant, i);
      plant.advance(kCycleUs);
      for (std::size_t a = 0; a < 3; ++a) {
        const double pressure = plant.pump_pressures_pa()[a == kArm ? 0 : 1];
        regenerated += 0.01 * plant.section_flows()[a].recycle_in_m3ps * pressure;
      }
      const double rest = account.in_j() - account.lost_j() - (plant.stored_energy_j() - before);
      largest = std::max(largest, std::fabs(rest));
    }
    std::printf(
        "pumps %.0f, tip %.0f J; leak %.0f, relief %.0f, bypass %.0f, valve %.0f, "
        "port relief %.0f, piston leak %.0f, friction %.0f, end stops %.0f, stored %.0f J; "
        "open at most %.1f J, %.5f %% of the pumps' work\n",
        account.pump_j, account.tip_j, account.pump_leak_j, account.pump_relief_j, account.bypass_j,
        account.valve_j, account.port_relief_j, account.piston_leak_j, account.friction_j,
        account.end_stop_j, plant.stored_energy_j() - before, largest,
        100.0 * largest / account.pump_j);
    // Every kind below is more than what may be open.
    assert_near(largest / account.pump_j, 0.0, 2e-4);
    for (const double loss :
         {regenerated, account.pump_leak_j, account.pump_relief_j, account.bypass_j,
          account.valve_j, account.port_relief_j, account.piston_leak_j, account.friction_j}) {
      assert_true(loss > 5e-3 * account.pump_j);
    }
    assert_true(account.end_stop_j > 0.0);
  }
}

TEST(tip_work_is_force_times_way) {
  ExcavatorPlant plant(machine_22t(), kStart);
  plant.set_tip_force({15e3, 8e3});
  EnergyAccount account;
  plant.keep_account(&account);
  plant.advance(kSecondUs);
  const Eigen::Vector2d before = plant.tip().position_m;
  const double tip_before = account.tip_j;
  plant.set_duty({0.6, -0.5, 0.4}, true);
  plant.advance(kSecondUs);
  plant.set_duty({}, true);
  plant.advance(kSecondUs);
  const Eigen::Vector2d way = plant.tip().position_m - before;
  assert_true(way.norm() > 0.2);
  assert_near(account.tip_j - tip_before, 15e3 * way.x() + 8e3 * way.y(), 1.0);
}

double oil_held_m3(const ExcavatorPlant& plant) {
  double held = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    held += plant.cylinder(i).cap().content_m3() + plant.cylinder(i).rod().content_m3();
  }
  return held + plant.pump(0).line().content_m3() + plant.pump(1).line().content_m3();
}

// Oil in lines and chambers changes by what pumps give and tank takes, to rounding, voids or not.
TEST(oil_is_conserved) {
  ExcavatorPlantProfile profile = machine_22t();
  profile.makeup_paspm3 = 1e12;  // next to none, so that chambers boil
  const double step_s = profile.step_s();
  ExcavatorPlant plant(profile, kStart);
  const double before = oil_held_m3(plant);
  double pumped = 0.0;
  double hollow = 0.0;
  for (int i = 0; i < 150000; ++i) {
    if (i % 50 == 0) {
      drive(plant, i / 50);
    }
    plant.advance(profile.step_us);
    for (std::size_t p = 0; p < 2; ++p) {
      const PumpFlows& flows = plant.pump(p).flows();
      pumped += step_s * (flows.line_in_m3ps - flows.bypass_m3ps);
    }
    for (std::size_t a = 0; a < 3; ++a) {
      const SectionFlows& flows = plant.section_flows()[a];
      pumped += step_s * (flows.cap_in_m3ps + flows.rod_in_m3ps + flows.recycle_in_m3ps -
                          flows.supply_out_m3ps);
      hollow =
          std::max({hollow, plant.cylinder(a).cap().void_m3(), plant.cylinder(a).rod().void_m3()});
    }
  }
  std::printf("oil held changed by %.9f L, taken in %.9f L, largest void %.3f L\n",
              1e3 * (oil_held_m3(plant) - before), 1e3 * pumped, 1e3 * hollow);
  assert_true(hollow > 0.1e-3);
  assert_near(oil_held_m3(plant) - before, pumped, 1e-12);
  // And the chambers' space is where the links have the pistons, half a step ago.
  for (std::size_t a = 0; a < 3; ++a) {
    const CylinderGeometry& c = profile.machine.geometry.cylinder[a];
    const double area = c.count * 0.25 * 3.141592653589793 * c.bore_m * c.bore_m;
    assert_near(plant.cylinder(a).cap().volume_m3(),
                profile.dead_volume_m3[a] +
                    area * (plant.strokes_m()[a] - 0.5 * step_s * plant.stroke_velocities_mps()[a]),
                1e-9);
  }
}

double cylinder_force_n(const ExcavatorPlant& plant, std::size_t axis, double count, double bore_m,
                        double rod_m) {
  const double cap = count * 0.785398163397448 * bore_m * bore_m;
  const double rod = cap - count * 0.785398163397448 * rod_m * rod_m;
  return cap * plant.cap_pressures_pa()[axis] - rod * plant.rod_pressures_pa()[axis];
}

// A pose with right angles, worked by hand: boom along x, arm straight down, bucket back along -x.
// Every position below is the machine file's, turned by 0, 90 or 180 deg.
TEST(gravity_by_hand) {
  // Boom cylinder: base (0.46, -0.63), eye (2.33, 0.85).
  const double boom_length = std::hypot(2.33 - 0.46, 0.85 + 0.63);
  const double boom_lever = (0.46 * 0.85 + 0.63 * 2.33) / boom_length;
  // Arm cylinder: base (3.35, 1.02); the eye (-0.80, 0.28) of the arm is at (5.7 + 0.28, 0.80).
  const double arm_length = std::hypot(5.98 - 3.35, 0.80 - 1.02);
  const double arm_lever = (0.80 * 2.63 + 0.28 * 0.22) / arm_length;
  // Bucket, in the arm's frame: the lug (-0.06, 0.47) of the bucket, turned by -90 deg, is at
  // (2.9 + 0.47, 0.06). Rocker and coupler meet left of the line from the pivot (2.48, 0.02).
  const double dx = 3.37 - 2.48;
  const double dy = 0.06 - 0.02;
  const double square = dx * dx + dy * dy;
  const double along = (square + 0.64 * 0.64 - 0.60 * 0.60) / (2.0 * square);
  const double aside = std::sqrt(0.64 * 0.64 / square - along * along);
  const double rx = along * dx - aside * dy;  // pivot to rocker's end
  const double ry = along * dy + aside * dx;
  const double cx = (rx - dx) / 0.60;  // lug to rocker's end, unit
  const double cy = (ry - dy) / 0.60;
  const double px = 2.48 + rx - 0.42;  // cylinder base (0.42, 0.72) to rocker's end
  const double py = 0.02 + ry - 0.72;
  const double bucket_length = std::hypot(px, py);
  // The coupler's arm about the bucket pin, both rods' arms about the rocker's pivot.
  const double at_pin = 0.47 * cy - 0.06 * cx;
  const double at_pivot = rx * cy - ry * cx;
  const double bucket_lever = at_pin / at_pivot * (ry * px - rx * py) / bucket_length;

  // Mass centres: boom 2.75 from the foot; arm 0.10 beyond the arm pin at 5.7; bucket 0.62 before
  // the bucket pin, which hangs below the arm pin.
  const double boom_moment = 9.80665 * (2130.0 * 2.75 + 1010.0 * 5.80 + 860.0 * 5.08);
  const double arm_moment = 9.80665 * (1010.0 * 0.10 - 860.0 * 0.62);
  const double bucket_moment = -9.80665 * 860.0 * 0.62;

  const ExcavatorPlant plant(machine_22t(),
                             {boom_length - 1.760, arm_length - 1.795, bucket_length - 1.622});
  assert_near(plant.joint_angles_rad()[0], 0.0, 1e-9);
  assert_near(plant.joint_angles_rad()[1], -1.570796326794897, 1e-9);
  assert_near(plant.joint_angles_rad()[2], -1.570796326794897, 1e-9);
  // Extension raises the boom; it turns arm and bucket the other way round.
  assert_near(cylinder_force_n(plant, 0, 2.0, 0.120, 0.085) * boom_lever, boom_moment, 0.1);
  assert_near(cylinder_force_n(plant, 1, 1.0, 0.140, 0.100) * arm_lever, -arm_moment, 0.1);
  assert_near(cylinder_force_n(plant, 2, 1.0, 0.120, 0.085) * bucket_lever, -bucket_moment, 0.1);
  // 202.4 kN, 5.2 kN and 18.5 kN: as found with pencil.
  assert_near(boom_moment / boom_lever, 202.4e3, 0.1e3);
  assert_near(-arm_moment / arm_lever, 5.17e3, 0.01e3);
  assert_near(-bucket_moment / bucket_lever, 18.5e3, 0.05e3);
}
