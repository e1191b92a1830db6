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
  // A boom bends away from what it digs; a straight one has its bend at its foot.
  warnings.add_if(body.boom_bend_m.y() < -0.03 * boom_m, "boom.bend",
                  fmt::format("{:g} m below the line of boom foot and arm pin; usual: above it",
                              -body.boom_bend_m.y()));
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
  expect_likely_hydraulics(warnings, profile);
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
