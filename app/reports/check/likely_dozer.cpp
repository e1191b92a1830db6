// SPDX-License-Identifier: Apache-2.0
// The same of a dozer, from 3 to 110 t: all of it grows with the tracks' contact.
#include <cmath>

#include "app/reports/check/likely.hpp"

namespace graben::reports {
namespace {

/// Lengths of an undercarriage grow with this power of the mass, from a 4 t to a 112 t dozer of the
/// catalogues: 1.69 to 4.53 m of track contact.
constexpr double kLengthByMass = 0.29;

/// Tracks, drive and pumps of a machine of another mass: what is left of the profile that another
/// one was made from.
void expect_class(Warnings& warnings, const DozerProfile& profile) {
  const DozerBody& body = profile.body;
  const HstProfile& hst = profile.hst;
  const double mass_t = 1e-3 * body.mass_kg;
  const double size_m = std::pow(mass_t, kLengthByMass);
  const std::string under = fmt::format("of a machine of {:.3g} t", mass_t);
  const std::string other = "; tracks of a machine of another mass?";
  warnings.expect("body.track_contact", body.track_contact_m, 1.055 * size_m, 1.75 * size_m,
                  fmt::format("track contact {}{}", under, other), "m");
  warnings.expect("body.half_gauge", body.half_gauge_m, 0.31 * size_m, 0.6 * size_m,
                  fmt::format("half gauge {}{}", under, other), "m");
  const double turns_ps = hst.engine_radps / kTwoPi;
  const double travel_lpm = 6e4 * 2.0 * hst.pump_m3prev * turns_ps;
  warnings.expect("hst.pump_displacement", travel_lpm / mass_t, 16.0, 80.0,
                  fmt::format("{:.0f} L/min of both travel pumps, by its mass; those of a machine "
                              "of another mass?",
                              travel_lpm),
                  "L/min/t");
  // Of both tracks at the usual relief of a transmission, which no profile has.
  constexpr double kRelief_pa = 42e6;
  const double pull_n =
      2.0 * hst.motor_m3prev / kTwoPi * kRelief_pa * hst.gear_ratio / hst.sprocket_radius_m;
  constexpr double kGravity_mps2 = 9.80665;
  warnings.expect("hst.motor_displacement", pull_n / (kGravity_mps2 * body.mass_kg), 0.9, 5.0,
                  fmt::format("{:.0f} kN of pull at 42 MPa by motor, hst.gear_ratio and sprocket, "
                              "over the machine's weight",
                              1e-3 * pull_n));
  const double blade_lpm = 6e4 * profile.implement.displacement_m3prev * turns_ps;
  const double area_m2 = std::pow(mass_t, 2.0 / 3.0);
  warnings.expect("implement.pump.displacement", blade_lpm, 14.0 * area_m2, 70.0 * area_m2,
                  fmt::format("flow of the implement's pump {}; the pump of a machine of another "
                              "mass?",
                              under),
                  "L/min");
}

void expect_undercarriage(Warnings& warnings, const DozerProfile& profile) {
  const DozerBody& body = profile.body;
  const double contact_m = body.track_contact_m;
  warnings.expect(
      "body.half_gauge", body.half_gauge_m / contact_m, 0.22, 0.55,
      fmt::format("{:g} m from the machine's middle to a track's, over the track contact "
                  "of {:g} m; the whole gauge?",
                  body.half_gauge_m, contact_m));
  warnings.expect(
      "hst.sprocket_radius", profile.hst.sprocket_radius_m / contact_m, 0.08, 0.22,
      fmt::format("{:g} m over the track contact; the diameter?", profile.hst.sprocket_radius_m));
  const double springs_npm = 2.0 * body.wheels * body.suspension_npm;
  warnings.expect("body.suspension.stiffness", std::sqrt(springs_npm / body.mass_kg) / kTwoPi, 2.0,
                  30.0, "heave of the body on the springs of all wheels", "Hz");
  constexpr double kGravity_mps2 = 9.80665;
  warnings.expect("travel.push_max", profile.travel.push_max_n / (kGravity_mps2 * body.mass_kg),
                  0.3, 1.0,
                  fmt::format("{:.0f} kN against the blade, over the machine's weight",
                              1e-3 * profile.travel.push_max_n));
}

void expect_blade(Warnings& warnings, const DozerProfile& profile) {
  const BladeGeometry& blade = profile.blade;
  const double contact_m = profile.body.track_contact_m;
  warnings.add_if(blade.cylinder_count < 2, "blade.cylinder.count",
                  fmt::format("{}; usual: 2, a bore is that of one", blade.cylinder_count));
  warnings.expect("blade.cylinder.bore", blade.bore_m / contact_m, 0.022, 0.08,
                  fmt::format("bore of {:g} m over the track contact", blade.bore_m));
  warnings.add_if(blade.edge_max_m < -blade.edge_min_m, "blade.range",
                  fmt::format("{:g} m below the ground line and {:g} m above it; usual: the blade "
                              "rises farther than it digs",
                              -blade.edge_min_m, blade.edge_max_m));
  warnings.expect("implement.spool_to_duty", profile.implement.spool_to_duty.y_last(), 0.3, 1.0,
                  "duty of a spool that is fully open, a share of 1000 per mille");
  if (profile.tilt.present) {
    warnings.expect(
        "tilt.edge_width", profile.tilt.edge_width_m / contact_m, 0.7, 2.0,
        fmt::format("edge of {:g} m over the track contact", profile.tilt.edge_width_m));
    warnings.expect("tilt.spool_to_duty", profile.tilt.spool_to_duty.y_last(), 0.3, 1.0,
                    "duty of a spool that is fully open, a share of 1000 per mille");
  }
}

void expect_drive(Warnings& warnings, const DozerProfile& profile) {
  const HstProfile& hst = profile.hst;
  warnings.expect("hst.engine_speed", 60.0 / kTwoPi * hst.engine_radps, 1000.0, 2600.0,
                  "engine at work", "rpm");
  warnings.expect("hst.motor_displacement", hst.motor_m3prev / hst.pump_m3prev, 0.5, 4.0,
                  "a motor over its pump");
  const double contact_m = profile.body.track_contact_m;
  const double flow_lpm = 6e4 * profile.implement.displacement_m3prev * hst.engine_radps / kTwoPi;
  warnings.expect(
      "implement.pump.displacement", flow_lpm / (contact_m * contact_m), 4.0, 60.0,
      fmt::format("{:.0f} L/min of the implement's pump, over the squared track contact", flow_lpm),
      "L/min/m2");
  warnings.expect("grade.tolerance", 1e3 * profile.grade.tolerance_m, 3.0, 150.0,
                  "how far off the design the ground may come out", "mm");
}

}  // namespace

void expect_likely(Warnings& warnings, const DozerProfile& profile) {
  expect_class(warnings, profile);
  expect_undercarriage(warnings, profile);
  expect_blade(warnings, profile);
  expect_drive(warnings, profile);
}

}  // namespace graben::reports
