// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "app/machines/answer_section.hpp"
#include "app/machines/axis_names.hpp"
#include "app/reports/check/likely.hpp"
#include "app/reports/check/warnings.hpp"

namespace graben::reports {
namespace {

using machines::kAxisNames;
using machines::kDriveNames;

/// Mass over the cube of the length, kg/m3, and moment of inertia over mass and squared length, of
/// backhoes from 1.5 to 50 t with a wide margin.
struct LinkClass {
  double least_kgpm3;
  double most_kgpm3;
};
constexpr std::array<LinkClass, kAxisCount> kLinkClass = {
    {{4.0, 40.0}, {8.0, 80.0}, {60.0, 800.0}}};

double link_length_m(const ExcavatorGeometry& geometry, unsigned i) {
  return i == kBoom  ? geometry.boom_length_m
         : i == kArm ? geometry.arm_length_m
                     : geometry.bucket_length_m;
}

void expect_geometry(Warnings& warnings, const ExcavatorProfile& profile) {
  const ExcavatorGeometry& geometry = profile.geometry;
  warnings.expect("arm.length", geometry.arm_length_m / geometry.boom_length_m, 0.3, 0.9,
                  fmt::format("arm of {:g} m on a boom of {:g} m, a share of it",
                              geometry.arm_length_m, geometry.boom_length_m));
  warnings.expect("bucket.length", geometry.bucket_length_m / geometry.boom_length_m, 0.12, 0.5,
                  fmt::format("bucket of {:g} m on a boom of {:g} m, a share of it",
                              geometry.bucket_length_m, geometry.boom_length_m));
  warnings.expect("body.boom_foot", geometry.boom_foot_m.y() / geometry.boom_length_m, 0.12, 0.6,
                  fmt::format("boom foot {:g} m above the ground, a share of the boom",
                              geometry.boom_foot_m.y()));
  for (unsigned i = 0; i < kAxisCount; ++i) {
    const CylinderGeometry& cylinder = geometry.cylinder[i];
    const std::string key = std::string(kAxisNames[i]) + ".cylinder";
    expect_rod(warnings, key, cylinder.bore_m, cylinder.rod_m);
    warnings.expect(key + ".closed_length",
                    (cylinder.closed_length_m - cylinder.stroke_m) / cylinder.bore_m, 1.5, 8.0,
                    fmt::format("pin to pin {:g} m closed with a stroke of {:g} m leaves {:.3f} m "
                                "for piston and eyes, in bores",
                                cylinder.closed_length_m, cylinder.stroke_m,
                                cylinder.closed_length_m - cylinder.stroke_m));
    warnings.expect(key + ".bore", cylinder.bore_m / geometry.boom_length_m, 0.012, 0.05,
                    fmt::format("bore of {:g} m on a boom of {:g} m, a share of it",
                                cylinder.bore_m, geometry.boom_length_m));
  }
}

void expect_pumps(Warnings& warnings, const ExcavatorProfile& profile) {
  for (unsigned j = 0; j < static_cast<unsigned>(profile.pump_count); ++j) {
    const PumpProfile& pump = profile.pump[j];
    const std::string at = fmt::format("pump[{}].", j);
    const double flow_m3ps = full_flow_m3ps(pump);
    warnings.expect(at + "displacement", flow_m3ps / profile.valve.section_flow_m3ps, 0.33, 3.0,
                    fmt::format("{:.0f} L/min at {:g} rad/s, over valve.section_flow of {:.0f} "
                                "L/min",
                                6e4 * flow_m3ps, pump.rated_speed_radps,
                                6e4 * profile.valve.section_flow_m3ps));
    const double leak_m3ps =
        (pump.leak_linear + pump.leak_quadratic * pump.relief_pa) * pump.relief_pa;
    warnings.expect(at + "leak_linear", leak_m3ps / flow_m3ps, 0.0, 0.25,
                    "leakage at relief, of the full flow");
    warnings.expect(at + "relief", pump.relief_pa * 1e-6, 10.0, 45.0, "relief", "MPa");
    warnings.add_if(profile.safety.idle_radps >= pump.rated_speed_radps, "safety.idle",
                    fmt::format("{:g} rad/s; {}speed, at work, is {:g} rad/s",
                                profile.safety.idle_radps, at, pump.rated_speed_radps));
    warnings.expect("sensors.pressure_range", profile.safety.pressure_rail_pa / pump.relief_pa, 1.0,
                    2.5,
                    fmt::format("sensors up to {:.1f} MPa on a pump with its relief at {:.1f} MPa, "
                                "a multiple of it",
                                1e-6 * profile.safety.pressure_rail_pa, 1e-6 * pump.relief_pa));
  }
}

void expect_valve(Warnings& warnings, const ExcavatorProfile& profile) {
  const ValveProfile& valve = profile.valve;
  for (unsigned i = 0; i < static_cast<unsigned>(profile.drive_count); ++i) {
    const SpoolProfile& spool = valve.spool[i];
    const std::string key = std::string("valve.") + kDriveNames[i];
    const auto [least, most] = std::minmax(
        {spool.extend_in_m2, spool.extend_out_m2, spool.retract_in_m2, spool.retract_out_m2});
    for (const double area_m2 : {least, most}) {
      warnings.expect(key,
                      1e-6 * edge_drop_pa(valve.section_flow_m3ps, area_m2, valve.discharge,
                                          valve.density_kgpm3),
                      0.02, 10.0,
                      fmt::format("pressure drop at section_flow over an area of {:g} m2 ({:.0f} "
                                  "mm2), fully open",
                                  area_m2, 1e6 * area_m2),
                      "MPa");
    }
    // A closed centre has none that could close.
    const bool has_bypass = profile.pump[0].regulator.kind != PumpKind::kLoadSensing;
    warnings.add_if(has_bypass && spool.bypass_closed >= spool.bypass_open,
                    std::string("valve.bypass.closed.") + kDriveNames[i],
                    fmt::format("{:g} is no less than valve.bypass.open, {:g}: the bypass does not "
                                "close",
                                spool.bypass_closed, spool.bypass_open));
  }
}

void expect_swing(Warnings& warnings, const ExcavatorProfile& profile) {
  if (!profile.has_swing()) {
    return;
  }
  const SpoolProfile& spool = profile.valve.spool[kSwing];
  const double flow_m3ps = std::min(full_flow_m3ps(profile.pump[static_cast<unsigned>(spool.pump)]),
                                    profile.valve.section_flow_m3ps);
  warnings.expect("swing.displacement",
                  profile.swing.displacement_m3prad * profile.swing.speed_max_radps / flow_m3ps,
                  0.1, 1.05,
                  fmt::format("flow that speed_max of {:g} rad/s takes, of what the section gives",
                              profile.swing.speed_max_radps));
}

void expect_task(Warnings& warnings, const ExcavatorProfile& profile) {
  const DigPath& path = profile.dig_path;
  for (const double attitude_rad : {path.attitude_at_x_min_rad, path.attitude_at_x_max_rad}) {
    warnings.expect("task.path.attitude", attitude_rad, -kPi, kPi,
                    "attitude of the bucket; degrees?", "rad");
  }
  warnings.add_if(
      profile.dig_swash_ratio[0] < 0.1, "task.swash",
      fmt::format("{:g} of full: the pumps give hardly any flow", profile.dig_swash_ratio[0]));
}

void expect_links(Warnings& warnings, const machines::SimulatedExcavator& machine) {
  for (unsigned i = 0; i < kAxisCount; ++i) {
    const plant::LinkBody& link = machine.plant.link[i];
    const std::string axis = kAxisNames[i];
    const double length_m = link_length_m(machine.profile.geometry, i);
    const double cube_m3 = length_m * length_m * length_m;
    warnings.expect(axis + ".mass", link.mass_kg, kLinkClass[i].least_kgpm3 * cube_m3,
                    kLinkClass[i].most_kgpm3 * cube_m3,
                    fmt::format("mass at a length of {:g} m", length_m), "kg");
    warnings.expect(axis + ".inertia", link.inertia_kgm2 / (link.mass_kg * length_m * length_m),
                    0.03, 0.4,
                    fmt::format("{:g} kg m2, over mass and squared length", link.inertia_kgm2));
    warnings.expect(
        axis + ".mass_centre", link.mass_centre_m.norm() / length_m, 0.1, 0.9,
        fmt::format("{:.3f} m from the pin, a share of the length", link.mass_centre_m.norm()));
  }
}

void expect_friction(Warnings& warnings, const machines::SimulatedExcavator& machine) {
  const ExcavatorProfile& profile = machine.profile;
  for (unsigned i = 0; i < kAxisCount; ++i) {
    const plant::PistonFriction& friction = machine.plant.friction[i];
    const PumpProfile& pump = profile.pump[static_cast<unsigned>(profile.valve.spool[i].pump)];
    const double force_n = pump.relief_pa * profile.geometry.cylinder[i].cap_area_m2();
    warnings.expect(
        "friction.coulomb", 100.0 * friction.coulomb_n / force_n, 0.05, 8.0,
        fmt::format("{:g} N of the {}, of the force at relief", friction.coulomb_n, kAxisNames[i]),
        "%");
    const double speed_mps = full_flow_m3ps(pump) / profile.geometry.cylinder[i].cap_area_m2();
    warnings.expect("friction.viscous", 100.0 * friction.viscous_nspm * speed_mps / force_n, 0.05,
                    10.0,
                    fmt::format("{:g} N s/m of the {} at full flow, of the force at relief",
                                friction.viscous_nspm, kAxisNames[i]),
                    "%");
  }
}

/// Of each side that says where it opens, and of the whole valve for the first that does not.
void expect_deadbands(Warnings& warnings, const machines::SimulatedExcavator& machine) {
  const ExcavatorProfile& profile = machine.profile;
  bool is_told = false;
  for (int drive = 0; drive < profile.drive_count; ++drive) {
    const auto k = static_cast<unsigned>(drive);
    for (const bool extends : {true, false}) {
      const plant::SpoolDynamics& spool = machine.plant.spool[k];
      const double deadband_ratio =
          extends ? spool.extend.deadband_ratio : spool.retract.deadband_ratio;
      const DutyTable& said = profile.valve.answer[k].side(extends).spool_to_duty;
      if (said.size() > 0) {
        expect_deadband(warnings, machines::answer_key(drive, extends) + "spool_to_duty",
                        deadband_ratio, said);
      } else if (!is_told) {
        expect_deadband(warnings, "valve.spool_to_duty", deadband_ratio,
                        profile.valve.spool_to_duty);
        is_told = true;
      }
    }
  }
}

void expect_plant(Warnings& warnings, const machines::SimulatedExcavator& machine) {
  const ExcavatorProfile& profile = machine.profile;
  const plant::ExcavatorPlantProfile& plant = machine.plant;
  expect_links(warnings, machine);
  expect_friction(warnings, machine);
  expect_oil(warnings, "valve", plant.bulk_modulus_pa);
  const plant::SpoolDynamics& spool = plant.spool[kBoom];
  expect_deadbands(warnings, machine);
  expect_spool(warnings, "valve", spool.time_constant_s, spool.damping, profile.safety.settle_s,
               profile.control.response_s);
  for (unsigned j = 0; j < static_cast<unsigned>(profile.pump_count); ++j) {
    warnings.add_if(profile.pump[j].relief_pa > plant.port_relief_pa,
                    fmt::format("pump[{}].relief", j),
                    fmt::format("{:.1f} MPa is over the ports' relief, valve.port_relief of {:.1f} "
                                "MPa: the ports limit every force",
                                1e-6 * profile.pump[j].relief_pa, 1e-6 * plant.port_relief_pa));
  }
  for (unsigned i = 0; i < kAxisCount; ++i) {
    const double swept_m3 =
        profile.geometry.cylinder[i].cap_area_m2() * profile.geometry.cylinder[i].stroke_m;
    warnings.expect("valve.dead_volume", plant.dead_volume_m3[i] / swept_m3, 0.01, 1.0,
                    fmt::format("{:.2f} L at the {}, of what its pistons sweep",
                                1e3 * plant.dead_volume_m3[i], kAxisNames[i]));
  }
  const double mode_hz = lowest_mode_hz(machine);
  warnings.add_if(profile.control.servo_frequency_hz > mode_hz, "control.servo_frequency",
                  fmt::format("{:g} Hz is above the linkage's lowest mode on the path, {:.2f} Hz: "
                              "the correction drives that mode instead of damping it",
                              profile.control.servo_frequency_hz, mode_hz));
  if (profile.has_swing()) {
    warnings.expect("swing.inertia", plant.platform.inertia_kgm2 / plant.link[kBoom].mass_kg, 2.0,
                    100.0,
                    fmt::format("{:g} kg m2 of the upper structure over the boom's mass, m2",
                                plant.platform.inertia_kgm2));
  }
}

}  // namespace

std::vector<Warning> excavator_warnings(const machines::ExcavatorMachine& machine,
                                        const machines::SimulatedExcavator* simulated) {
  const ExcavatorProfile& profile = machine.profile;
  Warnings warnings;
  expect_geometry(warnings, profile);
  expect_pumps(warnings, profile);
  expect_valve(warnings, profile);
  expect_swing(warnings, profile);
  expect_task(warnings, profile);
  expect_likely(warnings, profile);
  expect_times(warnings, profile.safety.settle_s, profile.control.sensor_timeout_s,
               profile.control.response_s);
  if (simulated != nullptr) {
    expect_plant(warnings, *simulated);
    expect_same_machine(warnings, *simulated);
  }
  return warnings.take();
}

}  // namespace graben::reports
