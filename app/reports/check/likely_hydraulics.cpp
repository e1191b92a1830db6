// SPDX-License-Identifier: Apache-2.0
// What a profile's oil, valve and pumps alone make unlikely; the bands are of
// likely_excavator.cpp's kind.
#include <algorithm>
#include <array>
#include <cmath>

#include "app/machines/axis_names.hpp"
#include "app/machines/excavator_sections.hpp"
#include "app/reports/check/likely.hpp"

namespace graben::reports {
namespace {

using machines::kAxisNames;
using machines::kDriveNames;

/// Of two pumps the one of the arm drives the swing, the other one boom and bucket: so the boom is
/// not slowed by what digs or swings.
void expect_pump_of_drives(Warnings& warnings, const ExcavatorProfile& profile) {
  if (profile.pump_count != 2) {
    return;
  }
  const auto& spool = profile.valve.spool;
  const auto expect = [&](bool usual, const char* drive, const char* text) {
    warnings.add_if(!usual, fmt::format("valve.pump.{}", drive), text);
  };
  expect(spool[kBoom].pump != spool[kArm].pump, "boom",
         "on the arm's pump; usual of two pumps: the other one");
  expect(spool[kBucket].pump == spool[kBoom].pump || spool[kBoom].pump == spool[kArm].pump,
         "bucket", "on the arm's pump; usual of two pumps: on the boom's");
  expect(!profile.has_swing() || spool[kSwing].pump == spool[kArm].pump, "swing",
         "on the boom's pump; usual of two pumps: on the arm's");
}

/// How far the links out level weigh on the boom cylinders, and what each is by itself.
void expect_oil_masses(Warnings& warnings, const ExcavatorProfile& profile) {
  constexpr std::array<Band, kAxisCount> kUsual_kgpm3 = {
      {{5.0, 20.0}, {12.0, 70.0}, {60.0, 450.0}}};
  constexpr double kGravity_mps2 = 9.80665;
  const ExcavatorGeometry& geometry = profile.geometry;
  const std::array<double, kAxisCount> length_m = {geometry.boom_length_m, geometry.arm_length_m,
                                                   geometry.bucket_length_m};
  double pin_m = 0.0;
  double moment_nm = 0.0;
  for (unsigned i = 0; i < kAxisCount; ++i) {
    const LinkMass& link = profile.oil.link[i];
    const double cube_m3 = length_m[i] * length_m[i] * length_m[i];
    const std::string axis = kAxisNames[i];
    warnings.expect("oil.mass", link.mass_kg, kUsual_kgpm3[i].least * cube_m3,
                    kUsual_kgpm3[i].most * cube_m3, fmt::format("{} of {:g} m", axis, length_m[i]),
                    "kg");
    warnings.expect(
        "oil.inertia", link.inertia_kgm2 / (link.mass_kg * length_m[i] * length_m[i]), 0.03, 0.4,
        fmt::format("{:g} kg m2 of the {}, over mass and squared length", link.inertia_kgm2, axis));
    warnings.expect("oil.mass_centre." + axis, link.centre_m.x() / length_m[i], 0.08, 0.9,
                    fmt::format("{:g} m along the link from its pin, a share of its length",
                                link.centre_m.x()));
    warnings.expect(
        "oil.mass_centre." + axis, link.centre_m.y() / length_m[i], -0.25, 0.4,
        fmt::format("{:g} m above the line of the pins, a share of the length", link.centre_m.y()));
    moment_nm += kGravity_mps2 * link.mass_kg * (pin_m + link.centre_m.x());
    pin_m += length_m[i];
  }
  warnings.expect("oil.mass", profile.oil.link[kBucket].mass_kg / profile.oil.link[kBoom].mass_kg,
                  0.1, 0.85, "bucket over boom");
  // The largest lever that the pins can have.
  const CylinderGeometry& boom = geometry.cylinder[kBoom];
  const double lever_m = std::min(boom.base_m.norm(), boom.eye_m.norm());
  const double relief_pa =
      profile.pump[static_cast<unsigned>(profile.valve.spool[kBoom].pump)].relief_pa;
  warnings.expect(
      "oil.mass", moment_nm / (relief_pa * boom.cap_area_m2() * lever_m), 0.06, 0.42,
      "moment of the links held out level, over the most that the boom's cylinders hold "
      "at relief");
}

void expect_oil_of(Warnings& warnings, const ExcavatorProfile& profile) {
  const OilProfile& oil = profile.oil;
  if (!oil.known()) {
    return;
  }
  warnings.expect("oil.bulk_modulus", 1e-9 * oil.bulk_modulus_pa, 0.4, 2.2,
                  "stiffness of the oil with its hoses", "GPa");
  for (unsigned i = 0; i < kAxisCount; ++i) {
    const CylinderGeometry& cylinder = profile.geometry.cylinder[i];
    warnings.expect("oil.dead_volume",
                    oil.dead_volume_m3[i] / (cylinder.cap_area_m2() * cylinder.stroke_m), 0.01, 1.0,
                    fmt::format("{:.3g} L at the {}, of what its pistons sweep",
                                1e3 * oil.dead_volume_m3[i], kAxisNames[i]));
  }
  expect_oil_masses(warnings, profile);
  warnings.expect("oil.spool_time_constant", 1e3 * oil.spool_time_constant_s, 4.0, 120.0,
                  "lag of a spool", "ms");
}

/// Drops at a pump's whole flow, of what only leads it to tank. Pumps that set their own swash have
/// a closed centre, or throttle there what they go by.
void expect_bypass(Warnings& warnings, const ExcavatorProfile& profile) {
  constexpr Band kUsual_mpa = {0.04, 8.0};
  if (profile.pump[0].regulator.kind != PumpKind::kPositive) {
    return;
  }
  const auto drop_mpa = [](double flow_m3ps, double c) {
    return 1e-6 * flow_m3ps * flow_m3ps / (c * c);
  };
  for (unsigned j = 0; j < static_cast<unsigned>(profile.pump_count); ++j) {
    const PumpProfile& pump = profile.pump[j];
    for (const double c : pump.bypass_series) {
      warnings.expect(fmt::format("pump[{}].bypass_series", j), drop_mpa(full_flow_m3ps(pump), c),
                      kUsual_mpa.least, kUsual_mpa.most,
                      fmt::format("pressure drop of the pump's full flow through {:g}", c), "MPa");
    }
  }
  for (unsigned i = 0; i < static_cast<unsigned>(profile.drive_count); ++i) {
    const SpoolProfile& spool = profile.valve.spool[i];
    const double flow_m3ps = full_flow_m3ps(profile.pump[static_cast<unsigned>(spool.pump)]);
    warnings.expect("valve.bypass.open", drop_mpa(flow_m3ps, spool.bypass_open), kUsual_mpa.least,
                    kUsual_mpa.most,
                    fmt::format("pressure drop of the pump's full flow through {:g}, {} at rest",
                                spool.bypass_open, kDriveNames[i]),
                    "MPa");
  }
}

void expect_spools(Warnings& warnings, const ExcavatorProfile& profile) {
  const ValveProfile& valve = profile.valve;
  warnings.expect("valve.spool_to_duty", valve.spool_to_duty.y_last(), 0.3, 1.0,
                  "duty of a spool that is fully open, a share of 1000 per mille");
  // Gravity helps a boom down and an arm in: outflow is led into the side that it empties.
  warnings.add_if(valve.spool[kBoom].regeneration == RegenerationSide::kExtend,
                  "valve.regeneration.boom.side",
                  "extend is up, where the boom's weight helps nothing; usual: retract");
  warnings.add_if(valve.spool[kArm].regeneration == RegenerationSide::kRetract,
                  "valve.regeneration.arm.side",
                  "retract is out, where the arm's weight helps little; usual: extend");
  for (unsigned i = 0; i < kAxisCount; ++i) {
    const SpoolProfile& spool = valve.spool[i];
    if (spool.regeneration != RegenerationSide::kNone) {
      warnings.expect(
          std::string("valve.regeneration.") + kDriveNames[i] + ".c_check",
          1e-6 * std::pow(valve.section_flow_m3ps / spool.c_check, 2.0), 0.3, 60.0,
          fmt::format("pressure drop of valve.section_flow through {:g}", spool.c_check), "MPa");
    }
    const double flow_m3ps = std::min(
        valve.section_flow_m3ps, full_flow_m3ps(profile.pump[static_cast<unsigned>(spool.pump)]));
    const CylinderGeometry& cylinder = profile.geometry.cylinder[i];
    warnings.expect(
        "valve.section_flow", cylinder.stroke_m * cylinder.cap_area_m2() / flow_m3ps, 1.2, 15.0,
        fmt::format("time of the {}'s whole stroke, one section alone", kAxisNames[i]), "s");
  }
}

void expect_all_pumps(Warnings& warnings, const ExcavatorProfile& profile) {
  double flow_m3ps = 0.0;
  double power_w = 0.0;
  for (unsigned j = 0; j < static_cast<unsigned>(profile.pump_count); ++j) {
    const PumpProfile& pump = profile.pump[j];
    flow_m3ps += full_flow_m3ps(pump);
    power_w += full_flow_m3ps(pump) * pump.relief_pa;
    const std::string at = fmt::format("pump[{}].", j);
    warnings.expect(at + "relief", 1e-6 * pump.relief_pa, 12.0, 60.0,
                    fmt::format("relief of the pump's line{}",
                                pump.relief_pa < 6e6 ? "; in MPa where bar was meant?" : ""),
                    "MPa");
    if (pump.regulator.kind == PumpKind::kLoadSensing) {
      warnings.expect(at + "load_sensing.margin", 1e-6 * pump.regulator.margin_pa, 1.0, 4.0,
                      "pressure that the pump keeps over the highest load", "MPa");
    }
    const auto* first = profile.valve.spool.begin();
    warnings.add_if(
        std::none_of(first, first + profile.drive_count,
                     [&](const SpoolProfile& spool) { return spool.pump == static_cast<int>(j); }),
        "valve.pump", fmt::format("pump {} feeds no drive", j + 1));
  }
  const double boom_m = profile.geometry.boom_length_m;
  warnings.expect("pump[0].displacement", 6e4 * flow_m3ps / (boom_m * boom_m), 4.0, 40.0,
                  fmt::format("{:.0f} L/min of all pumps, over the squared boom of {:g} m",
                              6e4 * flow_m3ps, boom_m),
                  "L/min/m2");
  if (profile.demand_swash.most_ratio > 0.0) {
    warnings.expect("task.pump_power", profile.demand_swash.most_power_w / power_w, 0.1, 1.2,
                    fmt::format("{:.0f} kW, over full flow at relief of all pumps",
                                1e-3 * profile.demand_swash.most_power_w));
  }
  warnings.expect(
      "task.speed", profile.dig_speed_mps / boom_m, 0.008, 0.4,
      fmt::format("{:g} m/s of the teeth, over the boom's length", profile.dig_speed_mps), "1/s");
}
}  // namespace

void expect_likely_hydraulics(Warnings& warnings, const ExcavatorProfile& profile) {
  expect_oil_of(warnings, profile);
  expect_bypass(warnings, profile);
  expect_spools(warnings, profile);
  expect_all_pumps(warnings, profile);
  expect_pump_of_drives(warnings, profile);
}

}  // namespace graben::reports
