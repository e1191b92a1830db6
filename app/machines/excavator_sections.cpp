#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/machines/axis_names.hpp"
#include "app/machines/excavator_sections.hpp"
#include "app/machines/shared_sections.hpp"

namespace graben::machines {
namespace {

constexpr Range kLength{0.1, 30.0, "m"};
constexpr Range kPin{-10.0, 10.0, "m"};
constexpr Range kFlowCoefficient{1e-9, 1e-3, "m3/(s sqrt(Pa))"};
constexpr Range kSpoolArea{1e-7, 1e-2, "m2"};
constexpr Range kPressure{1e6, 1e8, "Pa"};

/// The boom cylinder as (6) of Zhang et al. has it: B the boom foot, A the pin on the body, C that
/// on the boom; A below the horizontal X0, C above the boom's line X1.
void read_pins_by_angles(TomlReader& reader, const std::string& at, CylinderGeometry& cylinder) {
  const Range acute{0.0, 1.5, "rad"};
  const double ab_m = reader.number(at + "AB", {0.05, 10.0, "m"});
  const double bc_m = reader.number(at + "BC", {0.05, 10.0, "m"});
  const double below_rad = reader.number(at + "angle_ABX0", acute);
  const double above_rad = reader.number(at + "angle_CBX1", acute);
  cylinder.base_m = {ab_m * std::cos(below_rad), -ab_m * std::sin(below_rad)};
  cylinder.eye_m = {bc_m * std::cos(above_rad), bc_m * std::sin(above_rad)};
}

CylinderGeometry read_cylinder(TomlReader& reader, const std::string& axis, bool has_eye) {
  const std::string at = axis + ".cylinder.";
  CylinderGeometry cylinder;
  const CylinderSize size = read_cylinder_size(reader, axis + ".cylinder");
  cylinder.count = size.count;
  cylinder.bore_m = size.bore_m;
  cylinder.rod_m = size.rod_m;
  cylinder.closed_length_m = reader.number(at + "closed_length", kLength);
  cylinder.stroke_m = reader.number(at + "stroke", {0.05, 10.0, "m"});
  if (axis == kAxisNames[kBoom] && reader.has(at + "AB")) {
    read_pins_by_angles(reader, at, cylinder);
  } else {
    cylinder.base_m = reader.point(at + "base", kPin);
    if (has_eye) {
      cylinder.eye_m = reader.point(at + "eye", kPin);
    }
  }
  if (cylinder.stroke_m >= cylinder.closed_length_m) {
    reader.fail(at + "stroke", fmt::format("{} m; allowed: less than the closed length of {} m",
                                           cylinder.stroke_m, cylinder.closed_length_m));
  }
  return cylinder;
}

ExcavatorGeometry read_geometry(TomlReader& reader) {
  ExcavatorGeometry geometry;
  geometry.boom_length_m = reader.number("boom.length", kLength);
  geometry.arm_length_m = reader.number("arm.length", kLength);
  geometry.bucket_length_m = reader.number("bucket.length", kLength);
  for (unsigned i = 0; i < kAxisCount; ++i) {
    geometry.cylinder[i] = read_cylinder(reader, kAxisNames[i], i != kBucket);
  }
  geometry.linkage.rocker_pivot_m = reader.point("bucket.linkage.rocker_pivot", kPin);
  geometry.linkage.rocker_m = reader.number("bucket.linkage.rocker", kLength);
  geometry.linkage.coupler_m = reader.number("bucket.linkage.coupler", kLength);
  geometry.linkage.lug_m = reader.point("bucket.linkage.lug", kPin);
  return geometry;
}

/// Neither pump nor valve is to see more than it is built for.
void check_relief(TomlReader& reader, const std::string& pump, double relief_pa) {
  for (const std::string& key : {pump + "rated_pressure", std::string("valve.rated_pressure")}) {
    const double rated_pa = reader.number(key, kPressure);
    if (relief_pa > rated_pa) {
      reader.fail(pump + "relief",
                  fmt::format("{} Pa; allowed: at most {}, {} Pa", relief_pa, key, rated_pa));
    }
  }
}

/// A machine whose valve has a section for the swing; without one the swing is held.
bool has_swing_drive(const TomlReader& reader) { return reader.has("valve.swing"); }

SwingProfile read_swing(TomlReader& reader) {
  SwingProfile swing;
  swing.speed_max_radps = reader.number("swing.speed_max", {0.01, 5.0, "rad/s"});
  swing.acceleration_max_radps2 = reader.number("swing.acceleration_max", {0.01, 10.0, "rad/s2"});
  if (has_swing_drive(reader)) {
    swing.displacement_m3prad = reader.number("swing.displacement", {1e-5, 1e-1, "m3/rad"});
    swing.lever_m = reader.number("swing.lever", {0.05, 2.0, "m"});
    const std::vector<double> range = reader.numbers("swing.range", {-3.1, 3.1, "rad"}, 2);
    swing.right_end_rad = range[0];
    swing.left_end_rad = range[1];
    if (range[0] >= range[1]) {
      reader.fail("swing.range", fmt::format("[{}, {}] rad; allowed: first the right end, then the "
                                             "left one, which is more",
                                             range[0], range[1]));
    }
  }
  return swing;
}

LineProfile read_line(TomlReader& reader) {
  LineProfile line;
  line.acceleration_mps2 = reader.number("line.acceleration", {0.01, 10.0, "m/s2"});
  const std::vector<double> cylinder =
      reader.numbers("line.cylinder_acceleration", {0.01, 10.0, "m/s2"}, kAxisCount);
  std::copy(cylinder.begin(), cylinder.end(), line.cylinder_acceleration_mps2.begin());
  line.slow_error_m = reader.number("line.slow_error", {1e-3, 10.0, "m"});
  line.slow_error_s = reader.number("line.slow_error_per_speed", {0.0, 1.0, "s"});
  line.move_slow_error_m = reader.number("line.move_slow_error", {1e-3, 10.0, "m"});
  line.pace_rate_ps = reader.number("line.pace_rate", {0.05, 100.0, "1/s"});
  line.trim_ps2 = reader.number("line.trim", {0.0, 20.0, "1/s2"});
  line.trim_most_mps = reader.number("line.trim_most", {0.0, 0.1, "m/s"});
  return line;
}

PumpProfile read_pump(TomlReader& reader, unsigned index) {
  const std::string at = fmt::format("pump[{}].", index);
  PumpProfile pump;
  pump.displacement_m3prev = reader.number(at + "displacement", {1e-6, 1e-2, "m3/rev"});
  pump.rated_speed_radps = reader.number(at + "speed", {10.0, 1000.0, "rad/s"});
  pump.leak_linear = reader.number(at + "leak_linear", {0.0, 1e-9, "m3/(s Pa)"});
  pump.leak_quadratic = reader.number(at + "leak_quadratic", {0.0, 1e-16, "m3/(s Pa2)"});
  pump.relief_pa = reader.number(at + "relief", kPressure);
  check_relief(reader, at, pump.relief_pa);
  const std::vector<double> series = reader.numbers(at + "bypass_series", kFlowCoefficient, 2);
  std::copy(series.begin(), series.end(), pump.bypass_series.begin());
  return pump;
}

SpoolProfile read_spool(TomlReader& reader, const std::string& axis, int pump_count) {
  SpoolProfile spool;
  spool.pump = reader.integer("valve.pump." + axis, 1, pump_count) - 1;
  const std::vector<double> areas = reader.numbers("valve." + axis, kSpoolArea, 4);
  spool.extend_in_m2 = areas[0];
  spool.extend_out_m2 = areas[1];
  spool.retract_in_m2 = areas[2];
  spool.retract_out_m2 = areas[3];
  spool.bypass_open = reader.number("valve.bypass.open", kFlowCoefficient);
  spool.bypass_closed = reader.number("valve.bypass.closed." + axis, kFlowCoefficient);
  const std::string at = "valve.regeneration." + axis + ".";
  // A motor has nothing to regenerate: both its sides are alike.
  if (axis != kDriveNames[kSwing]) {
    spool.regeneration = static_cast<RegenerationSide>(
        reader.choice(at + "side", {"retract", "none", "extend"}) - 1);
  }
  if (spool.regeneration != RegenerationSide::kNone) {
    spool.c_drain = reader.number(at + "c_drain", kFlowCoefficient);
    spool.c_check = reader.number(at + "c_check", kFlowCoefficient);
    if (spool.c_drain >= spool.c_check) {
      reader.fail(at + "c_drain", fmt::format("{} m3/(s sqrt(Pa)); allowed: less than c_check, {}",
                                              spool.c_drain, spool.c_check));
    }
  }
  spool.force_offset_n = reader.number("valve.force_offset", {1.0, 1e6, "N"});
  const std::string inflow_check = "valve.inflow_check." + axis;
  if (reader.has(inflow_check)) {
    spool.c_inflow_check = reader.number(inflow_check, kFlowCoefficient);
  }
  return spool;
}

ValveProfile read_valve(TomlReader& reader, int pump_count, int drive_count) {
  ValveProfile valve;
  valve.spool_travel_m = reader.number("valve.spool_travel", {1e-3, 0.1, "m"});
  valve.opening_exponent = reader.number("valve.opening_exponent", {0.5, 4.0, ""});
  valve.discharge = reader.number("valve.discharge", {0.3, 1.0, ""});
  valve.density_kgpm3 = reader.number("valve.density", {700.0, 1100.0, "kg/m3"});
  valve.section_flow_m3ps = reader.number("valve.section_flow", {1e-5, 1e-1, "m3/s"});
  for (unsigned i = 0; i < static_cast<unsigned>(drive_count); ++i) {
    valve.spool[i] = read_spool(reader, kDriveNames[i], pump_count);
  }
  valve.spool_to_duty = read_spool_to_duty(reader, "valve.spool_to_duty");
  return valve;
}

ControlProfile read_control(TomlReader& reader) {
  auto control = read_control_of_valve<ControlProfile>(reader, "valve");
  control.convergence_length_m = reader.number("control.convergence_length", {0.02, 5.0, "m"});
  control.attitude_gain_ps = reader.number("control.attitude_gain", {0.0, 20.0, "1/s"});
  control.attitude_rate_max_radps =
      reader.number("control.attitude_rate_max", {0.05, 5.0, "rad/s"});
  control.approach_inner_m = reader.number("control.approach_inner", {0.005, 1.0, "m"});
  control.approach_outer_m = reader.number("control.approach_outer", {0.01, 2.0, "m"});
  control.approach_speed_mps = reader.number("control.approach_speed", {0.01, 1.0, "m/s"});
  control.stroke_end_gain_ps = reader.number("control.stroke_end_gain", {0.1, 20.0, "1/s"});
  control.lambda_policy = static_cast<McvPolicy>(
      reader.choice("control.lambda_policy", {"algorithm1", "connected", "global"}));
  control.lambda_rise.rate_ps = reader.number("control.lambda_rise", {0.1, 100.0, "1/s"});
  control.lambda_rise.reserve_n = reader.number("control.lambda_rise_reserve", {0.0, 1e5, "N"});
  control.lambda_rise.hold_share = reader.number("control.lambda_hold_share", {0.0, 1.0, ""});
  control.servo_gain_ps = reader.number("control.servo_gain", {0.0, 20.0, "1/s"});
  if (has_swing_drive(reader)) {
    control.swing_servo_most_rad = reader.number("control.swing_servo_most", {0.0, 1.0, "rad"});
    control.swing_lead_s = reader.number("control.swing_lead", {0.0, 2.0, "s"});
    control.swing_servo_gain_ps = reader.number("control.swing_servo_gain", {0.0, 20.0, "1/s"});
  }
  control.servo_most_m = reader.number("control.servo_most", {0.0, 0.2, "m"});
  control.servo_least_lambda = reader.number("control.servo_least_lambda", {0.01, 1.0, ""});
  control.servo_frequency_hz = reader.number("control.servo_frequency", {0.2, 100.0, "Hz"});
  control.servo_damping = reader.number("control.servo_damping", {0.1, 10.0, ""});
  control.pressure_filter_s = reader.number("control.pressure_filter", {0.0, 2.0, "s"});
  control.slow_error_m = reader.number("control.slow_error", {1e-3, 10.0, "m"});
  if (control.approach_outer_m <= control.approach_inner_m) {
    reader.fail("control.approach_outer",
                fmt::format("{} m; allowed: more than approach_inner, {} m",
                            control.approach_outer_m, control.approach_inner_m));
  }
  return control;
}

SafetyProfile read_safety(TomlReader& reader) {
  auto safety = read_safety_of_valve<SafetyProfile>(reader);
  if (has_swing_drive(reader)) {
    safety.swing_uncommanded_rad = reader.number("safety.swing_uncommanded", {0.01, 1.0, "rad"});
    safety.swing_stuck_rad = reader.number("safety.swing_stuck", {0.01, 1.0, "rad"});
  }
  safety.swash_tolerance = reader.number("safety.swash_tolerance", {0.01, 0.5, ""});
  safety.pressure_rail_pa = reader.number("sensors.pressure_range", {1e6, 1e8, "Pa"});
  return safety;
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

TeethPose read_teeth(TomlReader& reader, const std::string& at) {
  const std::vector<double> position = reader.numbers(at + ".position", {-30.0, 30.0, "m"}, 3);
  return {{position[0], position[1], position[2]},
          reader.number(at + ".attitude", {-7.0, 7.0, "rad"})};
}

ExcavatorProfile read_excavator_sections(TomlReader& reader) {
  ExcavatorProfile profile;
  profile.geometry = read_geometry(reader);
  profile.geometry.boom_foot_m = reader.point("body.boom_foot", kPin);
  profile.drive_count = has_swing_drive(reader) ? kDriveCount : kAxisCount;
  profile.swing = read_swing(reader);
  profile.line = read_line(reader);
  profile.pump_count = reader.table_count("pump", 1, kPumpCount);
  const auto pumps = static_cast<unsigned>(profile.pump_count);
  for (unsigned j = 0; j < pumps; ++j) {
    profile.pump[j] = read_pump(reader, j);
  }
  profile.valve = read_valve(reader, profile.pump_count, profile.drive_count);
  profile.control = read_control(reader);
  profile.dig_path = read_path(reader, "task.path");
  profile.dig_speed_mps = reader.number("task.speed", {0.01, 3.0, "m/s"});
  const double swash_ratio = reader.number("task.swash", {0.0, 1.0, ""});
  std::fill_n(profile.dig_swash_ratio.begin(), pumps, swash_ratio);
  profile.safety = read_safety(reader);
  return profile;
}

}  // namespace graben::machines
