#include <fmt/format.h>

#include <algorithm>

#include "app/machines/excavator_sections.hpp"
#include "app/machines/teeth_pose_key.hpp"
#include "firmware/excavator/field/rounded_rectangle.hpp"

namespace graben::machines {
namespace {

plant::SoilProfile read_soil(TomlReader& reader) {
  const std::string at = "experiment.soil.";
  plant::SoilProfile soil;
  soil.ground_y_m = reader.number(at + "ground", {-30.0, 30.0, "m"});
  const std::vector<double> bias = reader.numbers(at + "bias", {0.0, 1e6, "N"}, 2);
  soil.bias_n = {bias[0], bias[1]};
  soil.ramp_m = reader.number(at + "ramp", {0.0, 10.0, "m"});
  soil.sine_ratio = reader.number(at + "sine", {0.0, 1.0, ""});
  soil.sine_hz = reader.number(at + "sine_frequency", {0.0, 50.0, "Hz"});
  soil.random_ratio = reader.number(at + "random", {0.0, 1.0, ""});
  soil.random_hz = reader.number(at + "random_frequency", {0.0, 50.0, "Hz"});
  return soil;
}

/// It stands across the path, so that the bucket runs into it.
plant::ObstacleProfile read_obstacle(TomlReader& reader, const RoundedRectangle& path) {
  const std::string at = "experiment.obstacle.";
  plant::ObstacleProfile obstacle;
  const PathPoint point = path.at_share(reader.number(at + "share", {0.0, 1.0, ""}));
  obstacle.point_m = point.position_m;
  obstacle.normal = -point.tangent;
  obstacle.stiffness_npm = reader.number(at + "stiffness", {1e5, 1e9, "N/m"});
  obstacle.damping_nspm = reader.number(at + "damping", {0.0, 1e6, "N s/m"});
  obstacle.friction = reader.number(at + "friction", {0.0, 2.0, ""});
  obstacle.size_m = reader.number(at + "size", {0.01, 2.0, "m"});
  obstacle.hold_s = reader.number(at + "hold", {0.1, 60.0, "s"});
  return obstacle;
}

Uncertainty read_uncertainty(TomlReader& reader) {
  const Range share{0.0, 0.9, ""};
  return {reader.number("uncertainty.regeneration", share),
          reader.number("uncertainty.spool_opening", share),
          reader.number("uncertainty.bypass", share), reader.number("uncertainty.leak", share),
          reader.number("uncertainty.dead_time", share)};
}

AirManoeuvre read_air(TomlReader& reader) {
  AirManoeuvre air;
  air.path = read_path(reader, "experiment.air.path");
  const std::vector<double> start =
      reader.numbers("experiment.air.start", {-30.0, 30.0, "m, m, rad"}, 3);
  air.start = {start[0], start[1], start[2]};
  air.loops = reader.number("experiment.air.loops", {0.1, 10.0, ""});
  air.speed_mps = reader.number("experiment.air.speed", {0.01, 3.0, "m/s"});
  air.payload_kg = reader.number("experiment.air.payload", {0.0, 1e5, "kg"});
  air.payload_centre_m = reader.point("experiment.air.payload_centre", {-10.0, 10.0, "m"});
  return air;
}

LineTask read_line_task(TomlReader& reader) {
  const std::string at = "experiment.line";
  return {read_teeth(reader, at + ".from"), read_teeth(reader, at + ".to"),
          reader.number(at + ".duration", {0.5, 600.0, "s"})};
}

}  // namespace

DigPath read_path(TomlReader& reader, const std::string& at) {
  DigPath path;
  const std::vector<double> x = reader.numbers(at + ".x", {-30.0, 30.0, "m"}, 2);
  const std::vector<double> y = reader.numbers(at + ".y", {-30.0, 30.0, "m"}, 2);
  path.x_min_m = x[0];
  path.x_max_m = x[1];
  path.y_min_m = y[0];
  path.y_max_m = y[1];
  path.corner_radius_m = reader.number(at + ".corner_radius", {0.01, 10.0, "m"});
  const double half_side = 0.5 * std::min(path.x_max_m - path.x_min_m, path.y_max_m - path.y_min_m);
  if (!(half_side > 0.0)) {
    reader.fail(at, "x and y must each be given as [least, most]");
  } else if (path.corner_radius_m > half_side) {
    reader.fail(at + ".corner_radius", fmt::format("{} m; allowed: at most half the shorter side, "
                                                   "{} m",
                                                   path.corner_radius_m, half_side));
  }
  const auto attitude =
      reader.pairs(at + ".attitude", {-30.0, 30.0, "m"}, {-7.0, 7.0, "rad"}, 2, 2);
  if (attitude.size() == 2) {
    if (attitude[0].first != path.x_min_m || attitude[1].first != path.x_max_m) {
      reader.fail(at + ".attitude", "must be given at both ends of x, in their order");
    }
    path.attitude_at_x_min_rad = attitude[0].second;
    path.attitude_at_x_max_rad = attitude[1].second;
  }
  return path;
}

Experiment read_experiment_sections(TomlReader& reader, const DigPath& path) {
  Experiment experiment;
  experiment.uncertainty = read_uncertainty(reader);
  experiment.soil = read_soil(reader);
  experiment.obstacle = read_obstacle(reader, RoundedRectangle(path));
  experiment.air = read_air(reader);
  experiment.line = read_line_task(reader);
  experiment.stiff_bulk_modulus_pa = reader.number("valve.bulk_modulus_kim", {1e8, 1e11, "Pa"});
  return experiment;
}

}  // namespace graben::machines
