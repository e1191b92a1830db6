// SPDX-License-Identifier: Apache-2.0
// Cushions and hoses: what lies between a chamber and its valve.

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/plant/excavator_plant.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/plant/fixture/cylinder_circuit.hpp"

using namespace graben::plant;

using AxisArray = ExcavatorPlant::AxisArray;

// By hand: 200 L/min through a hose of 3e7 Pa s/m^3 and 2.7e10 Pa s^2/m^6.
TEST(hose_drops_0_4_mpa_at_200_l_per_min) {
  const ValveSection section(machine_22t().section(kArm));
  const double flow = 0.2 / 60.0;
  assert_near(section.hose_drop_pa(flow, 0.0), 0.1e6 + 0.3e6, 1.0);
  assert_near(section.hose_drop_pa(-flow, 0.0), -0.4e6, 1.0);
  // A cushion resists what leaves only.
  assert_near(section.hose_drop_pa(flow, 1e11), 0.4e6, 1.0);
  assert_near(section.hose_drop_pa(-flow, 1e11), -0.4e6 - 1e11 * flow * flow, 1.0);
}

// Steady extension: pump line to bore through edge and hose, rod side to tank through hose and
// edge.
TEST(hose_is_in_series_with_the_edge) {
  ExcavatorPlantProfile profile = hopsan_circuit(200);
  profile.hose_linear_paspm3 = 3e8;
  profile.hose_quadratic_pas2pm6 = 2e11;
  CylinderCircuit circuit(profile, 0.1, 20000.0, 60000.0);
  circuit.run(5.0, 0.4);
  const double k = 0.62 * std::sqrt(2.0 / 870.0) * 0.4;
  const double in = circuit.flows.supply_out_m3ps;
  const double out = -circuit.flows.rod_in_m3ps;
  assert_true(in > 1.5e-3);
  const auto drop = [&](double flow, double area) {
    return std::pow(flow / (k * area), 2) + 3e8 * flow + 2e11 * flow * flow;
  };
  const double hose_share = (3e8 * in + 2e11 * in * in) / drop(in, 1.70e-4);
  assert_true(hose_share > 0.3);
  assert_near(circuit.pump.pressure_pa() - circuit.cap_pa(), drop(in, 1.70e-4), 2e3);
  assert_near(circuit.rod_pa(), drop(out, 1.05e-4), 2e3);
  assert_near(circuit.cylinder.cap().content_m3(),
              circuit.cylinder.cap().volume_m3() * (1.0 + circuit.cap_pa() / 1.2e9), 1e-12);
}

TEST(cushion_grows_towards_the_end_only) {
  const ExcavatorPlantProfile profile = machine_22t();
  Cylinder cylinder(profile.cylinder(kArm), profile.step_s());
  const double cap_area = 0.785398163397448 * 0.140 * 0.140;
  const double rod_area = cap_area - 0.785398163397448 * 0.100 * 0.100;
  cylinder.set_motion(0.7, 0.0);
  assert_near(cylinder.cap_cushion_pas2pm6(), 0.0, 0.0);
  assert_near(cylinder.rod_cushion_pas2pm6(), 0.0, 0.0);
  // At half its length 15 MPa at 0.15 m/s.
  cylinder.set_motion(0.025, 0.0);
  assert_near(cylinder.cap_cushion_pas2pm6() * std::pow(cap_area * 0.15, 2), 15e6, 1.0);
  assert_near(cylinder.rod_cushion_pas2pm6(), 0.0, 0.0);
  cylinder.set_motion(1.504 - 0.025, 0.0);
  assert_near(cylinder.rod_cushion_pas2pm6() * std::pow(rod_area * 0.15, 2), 15e6, 1.0);
  // Continuous at its beginning, finite at and beyond the end.
  cylinder.set_motion(0.05 - 1e-9, 0.0);
  assert_near(cylinder.cap_cushion_pas2pm6() * std::pow(cap_area * 0.15, 2), 0.0, 1.0);
  cylinder.set_motion(-0.001, 0.0);
  assert_near(cylinder.cap_cushion_pas2pm6() * std::pow(cap_area * 0.15, 2), 49.0 * 15e6, 10.0);
}

// Both ways out of a chamber pass its cushion: by its return edge, and by its in-flow edge where
// the chamber is above the pump line. The way in does not.
TEST(cushion_throttles_every_way_out) {
  const double k = 0.62 * std::sqrt(2.0 / 870.0);
  ValveSection section(hopsan_circuit(200).section(kArm));
  section.set_command(1.0);
  repeat(20000, [&] { section.step(2e-4); });
  SectionPorts ports{{20e6, 0.0}, {4e6, 0.0}, {11e6, 0.0}, {0.0, 0.0}, 1e13, 2e13};
  const SectionFlows back = section.solve(ports);
  const double edge = 1.0 / std::pow(k * 1.70e-4, 2);
  const double return_edge = 1.0 / std::pow(k * 1.05e-4, 2);
  assert_near(back.cap_in_m3ps, -std::sqrt(9e6 / (edge + 1e13)), 1e-9);
  assert_near(back.rod_in_m3ps, -std::sqrt(4e6 / (return_edge + 2e13)), 1e-9);
  ports.cap.wave_pa = 2e6;
  assert_near(section.solve(ports).cap_in_m3ps, std::sqrt(9e6 / edge), 1e-9);
}

struct Impact {
  double speed_mps = 0.0;
  double overrun_m = 0.0;
  double highest_pa = 0.0;
  double time_s = 0.0;  ///< In the last 50 mm.
};

// Full duty into the end of one axis at full swash, chambers watched in every step.
Impact run_into_end(const ExcavatorPlantProfile& profile, std::size_t axis, double duty) {
  const double full = profile.machine.geometry.cylinder[axis].stroke_m;
  AxisArray start{0.7, 0.7, 0.6};
  start[axis] = duty > 0.0 ? full - 0.5 : 0.5;
  ExcavatorPlant plant(profile, start);
  ExcavatorPlant::DriveArray wanted{};
  wanted[axis] = duty;
  plant.set_duty(wanted, true);
  Impact impact;
  bool reached = false;
  for (int i = 0; i < 50000; ++i) {
    plant.advance(profile.step_us);
    const double stroke = plant.strokes_m()[axis];
    const double left = duty > 0.0 ? full - stroke : stroke;
    if (!reached && left <= 0.0) {
      impact.speed_mps = std::fabs(plant.stroke_velocities_mps()[axis]);
      reached = true;
    }
    impact.time_s += !reached && left < 0.05 ? profile.step_s() : 0.0;
    impact.overrun_m = std::max(impact.overrun_m, -left);
    for (std::size_t a = 0; a < 3; ++a) {
      impact.highest_pa = std::max({impact.highest_pa, plant.cylinder(a).cap().pressure_pa(),
                                    plant.cylinder(a).rod().pressure_pa()});
    }
  }
  assert_true(reached);
  return impact;
}

TEST(cushions_end_the_blow) {
  ExcavatorPlantProfile profile = machine_22t();
  profile.swash_ratio = {1.0, 1.0};
  ExcavatorPlantProfile bare = profile;
  bare.cushion_pressure_pa = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double duty : {1.0, -1.0}) {
      const Impact without = run_into_end(bare, axis, duty);
      const Impact with = run_into_end(profile, axis, duty);
      std::printf(
          "axis %zu, duty %+.0f: %.3f m/s without, %.3f m/s with cushion; %.1f and %.1f MPa; "
          "%.2f s in the cushion\n",
          axis, duty, without.speed_mps, with.speed_mps, 1e-6 * without.highest_pa,
          1e-6 * with.highest_pa, with.time_s);
      assert_true(with.speed_mps < 0.06);
      assert_true(with.speed_mps < 0.45 * without.speed_mps);
      assert_true(with.overrun_m < 0.5e-3);
      assert_true(with.time_s < 1.0);  // nor may it take for ever
      // 10 % above the port relief.
      assert_true(with.highest_pa < 1.1 * profile.port_relief_pa);
    }
  }
}
