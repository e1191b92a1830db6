// SPDX-License-Identifier: Apache-2.0
// The same of a dozer, from 3 to 110 t: all of it grows with the tracks' contact.
#include <cmath>

#include "app/reports/check/likely.hpp"

namespace graben::reports {
namespace {

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
  expect_undercarriage(warnings, profile);
  expect_blade(warnings, profile);
  expect_drive(warnings, profile);
}

}  // namespace graben::reports
