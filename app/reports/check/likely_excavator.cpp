// SPDX-License-Identifier: Apache-2.0
// What a profile alone makes unlikely: figures against its own geometry, and against what backhoes
// from 1.5 to 50 t have. Nearly all of them grow with the boom: areas and flows with its square,
// masses with its cube, so that one band holds for every class.
#include <algorithm>
#include <cmath>

#include "app/machines/axis_names.hpp"
#include "app/machines/excavator_sections.hpp"
#include "app/reports/check/likely.hpp"
#include "firmware/excavator/kinematics/excavator_kinematics.hpp"

namespace graben::reports {
namespace {

using machines::kAxisNames;
using machines::kDriveNames;

struct Band {
  double least;
  double most;
};

std::array<double, kAxisCount> lengths_m(const ExcavatorGeometry& geometry) {
  return {geometry.boom_length_m, geometry.arm_length_m, geometry.bucket_length_m};
}

/// Which way a cylinder turns its link, how many there are, and where its pins sit.
void expect_cylinders(Warnings& warnings, const ExcavatorGeometry& geometry) {
  // A swing boom or a small machine has one below its boom, up to some 8 t.
  constexpr double kOneCylinderBoom_m = 4.2;
  const std::array<CylinderGeometry, kAxisCount>& cylinder = geometry.cylinder;
  warnings.add_if(cylinder[kBoom].count < 2 && geometry.boom_length_m > kOneCylinderBoom_m,
                  "boom.cylinder.count",
                  fmt::format("1 below a boom of {:g} m; usual: 2, a bore is that of one",
                              geometry.boom_length_m));
  for (const unsigned i : {kArm, kBucket}) {
    warnings.add_if(cylinder[i].count > 1, std::string(kAxisNames[i]) + ".cylinder.count",
                    fmt::format("{}; usual: 1", cylinder[i].count));
  }
  const double arm_m2 = cylinder[kArm].cap_area_m2();
  warnings.expect("boom.cylinder.bore", cylinder[kBoom].cap_area_m2() / arm_m2, 0.85, 3.0,
                  "piston area of all boom cylinders, over the arm's");
  warnings.expect("bucket.cylinder.bore", cylinder[kBucket].cap_area_m2() / arm_m2, 0.35, 1.3,
                  "piston area of the bucket's cylinder, over the arm's");
  const double boom_m = geometry.boom_length_m;
  warnings.expect(
      "boom.cylinder.base", cylinder[kBoom].base_m.norm() / boom_m, 0.05, 0.3,
      fmt::format("pin on the body (AB) {:.3f} m from the boom foot, a share of the boom",
                  cylinder[kBoom].base_m.norm()));
  warnings.expect(
      "boom.cylinder.eye", cylinder[kBoom].eye_m.norm() / boom_m, 0.25, 0.75,
      fmt::format("pin on the boom (BC) {:.3f} m from the boom foot, a share of the boom",
                  cylinder[kBoom].eye_m.norm()));
  warnings.expect("arm.cylinder.eye", cylinder[kArm].eye_m.norm() / geometry.arm_length_m, 0.08,
                  0.5,
                  fmt::format("pin on the arm {:.3f} m from the arm's own, a share of the arm",
                              cylinder[kArm].eye_m.norm()));
  warnings.expect("bucket.cylinder.base", cylinder[kBucket].base_m.norm() / geometry.arm_length_m,
                  0.08, 0.6,
                  fmt::format("pin on the arm {:.3f} m from the arm's own, a share of the arm",
                              cylinder[kBucket].base_m.norm()));
}

/// Which joint ranges pins and strokes give.
void expect_ranges(Warnings& warnings, const ExcavatorGeometry& geometry) {
  const auto ranges = machines::joint_ranges(geometry);
  if (!ranges) {
    return;
  }
  constexpr std::array<std::array<Band, 2>, kAxisCount> kUsual_deg = {
      {{{{-85.0, -15.0}, {25.0, 90.0}}},
       {{{-178.0, -95.0}, {-65.0, 15.0}}},
       {{{-178.0, -90.0}, {-20.0, 80.0}}}}};
  for (unsigned i = 0; i < kAxisCount; ++i) {
    for (unsigned end = 0; end < 2; ++end) {
      warnings.expect(std::string(kAxisNames[i]) + ".angle", kDegreesPerRad * (*ranges)[i][end],
                      kUsual_deg[i][end].least, kUsual_deg[i][end].most,
                      fmt::format("{} angle that pins and stroke ends give; a pin's place or an "
                                  "angle in another unit?",
                                  end == 0 ? "least" : "largest"),
                      "deg");
    }
  }
}

void expect_body(Warnings& warnings, const ExcavatorGeometry& geometry) {
  const ExcavatorBody& body = geometry.body;
  const double boom_m = geometry.boom_length_m;
  const double bucket_m = geometry.bucket_length_m;
  warnings.expect("body.boom_foot", geometry.boom_foot_m.x() / boom_m, -0.2, 0.3,
                  fmt::format("boom foot {:g} m before the swing axis, a share of the boom",
                              geometry.boom_foot_m.x()));
  if (!body.known()) {
    return;
  }
  warnings.expect("bucket.width", body.bucket_width_m / bucket_m, 0.2, 2.5,
                  fmt::format("width of {:g} m on a bucket of {:g} m pin to tip, a share of it",
                              body.bucket_width_m, bucket_m));
  if (body.capacity_m3 > 0.0) {
    warnings.expect("bucket.capacity",
                    body.capacity_m3 / (body.bucket_width_m * bucket_m * bucket_m), 0.12, 0.9,
                    fmt::format("{:g} m3, over width and squared length", body.capacity_m3));
  }
  if (body.counterweight.known()) {
    warnings.expect("body.counterweight.radius", body.counterweight.radius_m / boom_m, 0.2, 0.9,
                    fmt::format("tail swing radius of {:g} m, a share of the boom",
                                body.counterweight.radius_m));
  }
}

/// How far the links out level weigh on the boom cylinders, and what each is by itself.
void expect_oil_masses(Warnings& warnings, const ExcavatorProfile& profile) {
  constexpr std::array<Band, kAxisCount> kUsual_kgpm3 = {
      {{5.0, 20.0}, {12.0, 70.0}, {60.0, 450.0}}};
  constexpr double kGravity_mps2 = 9.80665;
  const ExcavatorGeometry& geometry = profile.geometry;
  const std::array<double, kAxisCount> length_m = lengths_m(geometry);
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

void expect_platform(Warnings& warnings, const ExcavatorProfile& profile) {
  const SwingProfile& swing = profile.swing;
  warnings.expect("swing.speed_max", 60.0 / kTwoPi * swing.speed_max_radps, 4.0, 18.0,
                  "speed of the platform", "rpm");
  if (!profile.has_swing() || swing.inertia_kgm2 <= 0.0 || !profile.oil.known()) {
    return;
  }
  double links_kg = 0.0;
  for (const LinkMass& link : profile.oil.link) {
    links_kg += link.mass_kg;
  }
  const double boom_m = profile.geometry.boom_length_m;
  warnings.expect(
      "swing.inertia", swing.inertia_kgm2 / (links_kg * boom_m * boom_m), 0.25, 5.0,
      fmt::format("{:g} kg m2, over the links' mass and the squared boom", swing.inertia_kgm2));
}

}  // namespace

void expect_likely(Warnings& warnings, const ExcavatorProfile& profile) {
  expect_cylinders(warnings, profile.geometry);
  expect_ranges(warnings, profile.geometry);
  expect_body(warnings, profile.geometry);
  expect_oil_of(warnings, profile);
  expect_bypass(warnings, profile);
  expect_spools(warnings, profile);
  expect_all_pumps(warnings, profile);
  expect_platform(warnings, profile);
}

void expect_same_machine(Warnings& warnings, const machines::SimulatedExcavator& machine) {
  constexpr double kSame = 0.03;
  constexpr double kSameMass = 2.0;
  const ExcavatorGeometry& own = machine.profile.geometry;
  const ExcavatorGeometry& other = machine.plant.machine.geometry;
  const auto differs = [](double a, double b) { return std::abs(a - b) > kSame * std::abs(b); };
  for (unsigned i = 0; i < kAxisCount; ++i) {
    const std::string axis = kAxisNames[i];
    const double own_m = lengths_m(own)[i];
    const double other_m = lengths_m(other)[i];
    warnings.add_if(differs(own_m, other_m), axis + ".length",
                    fmt::format("{:g} m, where the machine that is simulated for it has {:g} m: "
                                "that is another machine",
                                own_m, other_m));
    const CylinderGeometry& cylinder = own.cylinder[i];
    const CylinderGeometry& simulated = other.cylinder[i];
    warnings.add_if(differs(cylinder.cap_area_m2(), simulated.cap_area_m2()) ||
                        differs(cylinder.stroke_m, simulated.stroke_m) ||
                        (cylinder.base_m - simulated.base_m).norm() > kSame * own_m,
                    axis + ".cylinder",
                    "its pins, bore or stroke are not those of the machine that is simulated for "
                    "it");
    const double mass_kg = machine.plant.link[i].mass_kg;
    if (machine.profile.oil.known() && mass_kg > 0.0) {
      warnings.expect("oil.mass", machine.profile.oil.link[i].mass_kg / mass_kg, 1.0 / kSameMass,
                      kSameMass,
                      fmt::format("{:g} kg of the {}, over the {:g} kg that are simulated",
                                  machine.profile.oil.link[i].mass_kg, axis, mass_kg));
    }
  }
}

}  // namespace graben::reports
