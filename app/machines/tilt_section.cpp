// SPDX-License-Identifier: Apache-2.0
#include "app/machines/tilt_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/machines/shared_sections.hpp"

namespace graben::machines {
namespace {

constexpr Range kPin{-3.0, 3.0, "m"};
/// Nearer to the axis the cylinder's line may not come: it would turn the blade with no lever.
constexpr double kLeastLever_m = 0.1;
constexpr int kPlaces = 40;

Eigen::Vector2d turned(const Eigen::Vector2d& at_m, double angle_rad) {
  return {at_m.x() * std::cos(angle_rad) - at_m.y() * std::sin(angle_rad),
          at_m.x() * std::sin(angle_rad) + at_m.y() * std::cos(angle_rad)};
}

/// Of the cylinder's line about the axis; its sign is the way that extension turns the blade.
double lever_m(const TiltProfile& tilt, double angle_rad) {
  const Eigen::Vector2d eye_m = turned(tilt.eye_m, angle_rad);
  const Eigen::Vector2d line = eye_m - tilt.base_m;
  return (tilt.base_m.x() * line.y() - tilt.base_m.y() * line.x()) / std::max(line.norm(), 1e-9);
}

}  // namespace

TiltProfile read_tilt(TomlReader& reader) {
  TiltProfile tilt;
  if (!reader.has("tilt")) {
    return tilt;
  }
  tilt.present = true;
  tilt.edge_width_m = reader.number("tilt.edge_width", {0.5, 10.0, "m"},
                                    "cutting edge, end to end; this and the next only with [tilt]");
  tilt.angle_most_rad = reader.number("tilt.range", {0.02, 0.5, "rad"},
                                      "of the blade against the machine, either way");
  const CylinderSize size = read_cylinder_size(reader, "tilt.cylinder");
  tilt.cylinder_count = size.count;
  tilt.bore_m = size.bore_m;
  tilt.rod_m = size.rod_m;
  tilt.base_m = reader.point("tilt.cylinder.base", kPin,
                             "pin on the push frame: y to the left, z up, from the middle of the "
                             "cutting edge, about which the blade tilts");
  tilt.eye_m = reader.point("tilt.cylinder.eye", kPin, "pin on the blade, level: y, z");
  tilt.valve_flow_max_m3ps = reader.number("tilt.valve_flow_max", {1e-5, 0.1, "m3/s"},
                                           "flow through the fully open tilt spool");
  tilt.spool_to_duty = read_spool_to_duty(reader, "tilt.spool_to_duty");
  tilt.gain_ps =
      reader.number("tilt.gain", {0.0, 50.0, "1/s"}, "error of the cross slope to its rate");
  tilt.integral_ps2 =
      reader.number("tilt.integral", {0.0, 100.0, "1/s2"}, "integral part of the tilt controller");
  tilt.integral_most_radps =
      reader.number("tilt.integral_most", {0.0, 1.0, "rad/s"}, "bound of the integral part");
  return tilt;
}

void check_tilt(TomlReader& reader, const TiltProfile& tilt) {
  if (!tilt.present) {
    return;
  }
  const double level_m = lever_m(tilt, 0.0);
  for (int i = -kPlaces; i <= kPlaces; ++i) {
    const double angle_rad = tilt.angle_most_rad * i / kPlaces;
    const double here_m = std::copysign(1.0, level_m) * lever_m(tilt, angle_rad);
    if (!(here_m >= kLeastLever_m)) {
      reader.fail("tilt.range",
                  fmt::format("with the blade at {:.3f} rad the cylinder acts {:.3f} m from the "
                              "tilt's axis; allowed: at least {} m, on the side of the level blade",
                              angle_rad, here_m, kLeastLever_m));
      return;
    }
  }
  const double first_m = (turned(tilt.eye_m, -tilt.angle_most_rad) - tilt.base_m).norm();
  const double last_m = (turned(tilt.eye_m, tilt.angle_most_rad) - tilt.base_m).norm();
  const double closed_m = std::min(first_m, last_m);
  if (std::abs(last_m - first_m) >= closed_m) {
    reader.fail("tilt.range", fmt::format("asks for a stroke of {:.3f} m; allowed: less than the "
                                          "closed length of {:.3f} m",
                                          std::abs(last_m - first_m), closed_m));
  }
}

}  // namespace graben::machines
