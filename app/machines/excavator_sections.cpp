// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/machines/answer_section.hpp"
#include "app/machines/axis_names.hpp"
#include "app/machines/body_section.hpp"
#include "app/machines/bus_key.hpp"
#include "app/machines/excavator_sections.hpp"
#include "app/machines/learning_keys.hpp"
#include "app/machines/mark_section.hpp"
#include "app/machines/oil_section.hpp"
#include "app/machines/pump_section.hpp"
#include "app/machines/sensor_section.hpp"
#include "app/machines/shared_sections.hpp"
#include "app/machines/swash_keys.hpp"

namespace graben::machines {
namespace {

constexpr Range kLength{0.1, 30.0, "m"};
constexpr Range kPin{-10.0, 10.0, "m"};
constexpr Range kFlowCoefficient{1e-9, 1e-3, "m3/(s sqrt(Pa))"};
constexpr Range kSpoolArea{1e-7, 1e-2, "m2"};

/// The boom cylinder as (6) of Zhang et al. has it: B the boom foot, A the pin on the body, C that
/// on the boom; A below the horizontal X0, C above the boom's line X1.
void read_pins_by_angles(TomlReader& reader, const std::string& at, CylinderGeometry& cylinder) {
  const Range acute{0.0, 1.5, "rad"};
  const double ab_m = reader.number(
      at + "AB", {0.05, 10.0, "m"},
      "boom foot to the pin on the body; with BC and the two angles instead of base and eye");
  const double bc_m =
      reader.number(at + "BC", {0.05, 10.0, "m"}, "boom foot to the pin on the boom");
  const double below_rad =
      reader.number(at + "angle_ABX0", acute, "pin on the body below the horizontal");
  const double above_rad =
      reader.number(at + "angle_CBX1", acute, "pin on the boom above the line of its pins");
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
  cylinder.closed_length_m = reader.number(at + "closed_length", kLength, "pin to pin, closed");
  cylinder.stroke_m =
      reader.number(at + "stroke", {0.05, 10.0, "m"}, "stroke; less than the closed length");
  if (axis == kAxisNames[kBoom] && reader.has(at + "AB")) {
    read_pins_by_angles(reader, at, cylinder);
  } else {
    cylinder.base_m = reader.point(at + "base", kPin,
                                   "pin on the link nearer to the body: boom's in the body frame, "
                                   "arm's in the boom frame, bucket's in the arm frame");
    if (has_eye) {
      cylinder.eye_m = reader.point(at + "eye", kPin, "pin on the moved link, in its frame");
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
  geometry.boom_length_m = reader.number("boom.length", kLength, "pin to pin");
  geometry.arm_length_m = reader.number("arm.length", kLength, "pin to pin");
  geometry.bucket_length_m = reader.number("bucket.length", kLength, "pin to teeth");
  for (unsigned i = 0; i < kAxisCount; ++i) {
    geometry.cylinder[i] = read_cylinder(reader, kAxisNames[i], i != kBucket);
  }
  geometry.linkage.rocker_pivot_m =
      reader.point("bucket.linkage.rocker_pivot", kPin, "pivot of the rocker, arm frame");
  geometry.linkage.rocker_m = reader.number("bucket.linkage.rocker", kLength,
                                            "length of the rocker, whose end the cylinder pushes");
  geometry.linkage.coupler_m =
      reader.number("bucket.linkage.coupler", kLength,
                    "length of the link from the rocker's end to the bucket's lug");
  geometry.linkage.lug_m = reader.point("bucket.linkage.lug", kPin,
                                        "lug on the bucket, bucket frame (x from pin to teeth)");
  return geometry;
}

/// A machine whose valve has a section for the swing; without one the swing is held.
bool has_swing_drive(const TomlReader& reader) { return reader.has("valve.swing"); }

SwingProfile read_swing(TomlReader& reader) {
  SwingProfile swing;
  swing.speed_max_radps = reader.number("swing.speed_max", {0.01, 5.0, "rad/s"}, "fastest swing");
  swing.acceleration_max_radps2 = reader.number("swing.acceleration_max", {0.01, 10.0, "rad/s2"},
                                                "acceleration that plans use for the swing");
  if (has_swing_drive(reader)) {
    swing.displacement_m3prad =
        reader.number("swing.displacement", {1e-5, 1e-1, "m3/rad"},
                      "motor with its reduction, per radian of swing; only with valve.swing");
    swing.inertia_kgm2 = reader.number_or(0.0, "swing.inertia", {1e2, 1e7, "kg m2"},
                                          "of all that turns, links half out; damps its oil");
    swing.lever_m = reader.number(
        "swing.lever", {0.05, 2.0, "m"},
        "where the motor stands as a cylinder in the valve's equations; only with valve.swing");
    const std::size_t errors = reader.errors().size();
    const std::vector<double> range =
        reader.numbers("swing.range", {-3.1, 3.1, "rad"}, 2,
                       "right and left end of the swing; only with valve.swing");
    swing.right_end_rad = range[0];
    swing.left_end_rad = range[1];
    if (range[0] >= range[1] && reader.errors().size() == errors) {
      reader.fail("swing.range", fmt::format("[{}, {}] rad; allowed: first the right end, then the "
                                             "left one, which is more",
                                             range[0], range[1]));
    }
  }
  return swing;
}

LineProfile read_line(TomlReader& reader) {
  LineProfile line;
  line.acceleration_mps2 = reader.number("line.acceleration", {0.01, 10.0, "m/s2"},
                                         "acceleration of the teeth on a planned line");
  const std::vector<double> cylinder =
      reader.numbers("line.cylinder_acceleration", {0.01, 10.0, "m/s2"}, kAxisCount,
                     "acceleration of boom, arm, bucket cylinder on a plan");
  std::copy(cylinder.begin(), cylinder.end(), line.cylinder_acceleration_mps2.begin());
  line.slow_error_m = reader.number("line.slow_error", {1e-3, 10.0, "m"},
                                    "error of the teeth at which a line goes on at half its speed");
  line.slow_error_s = reader.number("line.slow_error_per_speed", {0.0, 1.0, "s"},
                                    "so much more of that error for each m/s of the line's speed");
  line.move_slow_error_m = reader.number("line.move_slow_error", {1e-3, 10.0, "m"},
                                         "the same error on a move of the drives");
  line.pace_rate_ps =
      reader.number("line.pace_rate", {0.05, 100.0, "1/s"}, "fastest change of a plan's pace");
  line.trim_ps2 = reader.number("line.trim", {0.0, 20.0, "1/s2"},
                                "how fast a drive's learnt bias follows its filtered correction");
  line.trim_most_mps =
      reader.number("line.trim_most", {0.0, 0.1, "m/s"}, "bound of the learnt bias");
  return line;
}

AssistProfile read_assist(TomlReader& reader) {
  AssistProfile assist;
  assist.window_m = reader.number_or(0.3, "assist.window", {0.05, 1.0, "m"},
                                     "task Assist holds the edge from this near to the design on");
  assist.offset_m = reader.number_or(0.0, "assist.offset", {0.0, 0.5, "m"},
                                     "so high over the design task Assist holds the edge");
  if (assist.offset_m >= assist.window_m) {
    reader.fail("assist.offset", fmt::format("{} m; allowed: less than assist.window, {} m, or an "
                                             "edge on the design would be away from it",
                                             assist.offset_m, assist.window_m));
  }
  return assist;
}

SpoolProfile read_spool(TomlReader& reader, const std::string& axis, int pump_count,
                        PumpKind kind) {
  SpoolProfile spool;
  // A list of keys is of any machine.
  spool.pump = reader.integer("valve.pump." + axis, 1, reader.lists() ? kPumpCount : pump_count,
                              "number of the pump that feeds it, from 1") -
               1;
  const std::vector<double> areas =
      reader.numbers("valve." + axis, kSpoolArea, 4,
                     "areas of the fully open spool: extend in, extend out, retract in, retract "
                     "out; valve.swing makes the swing a drive");
  spool.extend_in_m2 = areas[0];
  spool.extend_out_m2 = areas[1];
  spool.retract_in_m2 = areas[2];
  spool.retract_out_m2 = areas[3];
  read_bypass(reader, axis, kind, spool);
  const std::string at = "valve.regeneration." + axis + ".";
  // A motor has nothing to regenerate: both its sides are alike.
  if (axis != kDriveNames[kSwing]) {
    spool.regeneration = static_cast<RegenerationSide>(
        reader.choice(at + "side", {"retract", "none", "extend"},
                      "motion whose outflow is led back into the inflow") -
        1);
  }
  if (spool.regeneration != RegenerationSide::kNone) {
    spool.c_drain = reader.number(
        at + "c_drain", kFlowCoefficient,
        "flow coefficient of the drain while regenerating; less than c_check; unless side is none");
    spool.c_check =
        reader.number(at + "c_check", kFlowCoefficient,
                      "flow coefficient of the regeneration's check valve; unless side is none");
    if (spool.c_drain >= spool.c_check) {
      reader.fail(at + "c_drain", fmt::format("{} m3/(s sqrt(Pa)); allowed: less than c_check, {}",
                                              spool.c_drain, spool.c_check));
    }
  }
  spool.force_offset_n = reader.number("valve.force_offset", {1.0, 1e6, "N"},
                                       "least drive force that the solution keeps (F_offset)");
  spool.c_inflow_check = reader.number_or(
      0.0, "valve.inflow_check." + axis, kFlowCoefficient,
      "flow coefficient of an extra check valve before the spool; 0: there is none");
  return spool;
}

ValveProfile read_valve(TomlReader& reader, int pump_count, int drive_count, PumpKind kind) {
  ValveProfile valve;
  valve.spool_travel_m =
      reader.number("valve.spool_travel", {1e-3, 0.1, "m"}, "spool from neutral to fully open");
  valve.opening_exponent = reader.number("valve.opening_exponent", {0.5, 4.0, ""},
                                         "area over travel: (travel / full travel) to this power");
  valve.discharge = reader.number("valve.discharge", {0.3, 1.0, ""},
                                  "discharge coefficient of the metering edges");
  valve.density_kgpm3 = reader.number("valve.density", {700.0, 1100.0, "kg/m3"}, "oil");
  valve.section_flow_m3ps =
      reader.number("valve.section_flow", {1e-5, 1e-1, "m3/s"}, "rated flow of one section");
  for (unsigned i = 0; i < static_cast<unsigned>(drive_count); ++i) {
    valve.spool[i] = read_spool(reader, kDriveNames[i], pump_count, kind);
  }
  valve.spool_to_duty = read_spool_to_duty(reader, "valve.spool_to_duty");
  read_answers(reader, drive_count, valve);
  return valve;
}

ControlProfile read_control(TomlReader& reader) {
  auto control = read_control_of_valve<ControlProfile>(reader, "valve");
  control.law = static_cast<ControlLaw>(reader.choice(
      "control.law", {kLawNames.begin(), kLawNames.end()},
      "feedback: each drive's integrated error, the oil as a state (needs [oil]), or none (Kim)"));
  control.convergence_length_m =
      reader.number("control.convergence_length", {0.02, 5.0, "m"},
                    "distance from the path at which the field points at it by 45 degrees");
  control.attitude_gain_ps =
      reader.number("control.attitude_gain", {0.0, 20.0, "1/s"}, "attitude error to attitude rate");
  control.attitude_rate_max_radps = reader.number("control.attitude_rate_max", {0.05, 5.0, "rad/s"},
                                                  "bound of the field's attitude rate");
  control.approach_inner_m =
      reader.number("control.approach_inner", {0.005, 1.0, "m"},
                    "stroke distance below which the contour field alone leads");
  control.approach_outer_m = reader.number(
      "control.approach_outer", {0.01, 2.0, "m"},
      "stroke distance above which the straight approach alone leads; more than approach_inner");
  control.approach_speed_mps = reader.number("control.approach_speed", {0.01, 1.0, "m/s"},
                                             "fastest cylinder of the approach");
  control.stroke_end_gain_ps =
      reader.number("control.stroke_end_gain", {0.1, 20.0, "1/s"},
                    "fastest approach to a cylinder's end, per metre left");
  control.lambda_policy = static_cast<McvPolicy>(
      reader.choice("control.lambda_policy", {"algorithm1", "connected", "global"},
                    "how lambda, the common slow-down, is found: algorithm1 (Kim), connected, or "
                    "global, the largest feasible one"));
  control.lambda_rise.rate_ps = reader.number("control.lambda_rise", {0.1, 100.0, "1/s"},
                                              "fastest rise of lambda; it falls at once");
  control.lambda_rise.reserve_n =
      reader.number("control.lambda_rise_reserve", {0.0, 1e6, "N"},
                    "drive force beyond the need that a rise of lambda takes");
  control.lambda_rise.hold_share = reader.number("control.lambda_hold_share", {0.0, 1.0, ""},
                                                 "share of that reserve with which lambda stays");
  control.servo_gain_ps =
      reader.number("control.servo_gain", {0.0, 20.0, "1/s"}, "integrated stroke error to speed");
  if (has_swing_drive(reader)) {
    control.swing_servo_most_rad =
        reader.number("control.swing_servo_most", {0.0, 1.0, "rad"},
                      "bound of the swing's integrated error; only with valve.swing");
    control.swing_lead_s =
        reader.number("control.swing_lead", {0.0, 2.0, "s"},
                      "lag of the platform behind its spool; only with valve.swing");
    control.swing_servo_gain_ps =
        reader.number("control.swing_servo_gain", {0.0, 20.0, "1/s"},
                      "integrated error of the swing to speed; only with valve.swing");
  }
  control.servo_most_m =
      reader.number("control.servo_most", {0.0, 0.2, "m"}, "bound of the integrated stroke error");
  control.servo_least_lambda = reader.number("control.servo_least_lambda", {0.01, 1.0, ""},
                                             "corrections keep full authority down to this lambda");
  control.servo_frequency_hz =
      reader.number("control.servo_frequency", {0.2, 100.0, "Hz"},
                    "low-pass of the integrated error, undamped; below the linkage's lowest mode");
  control.servo_damping =
      reader.number("control.servo_damping", {0.1, 10.0, ""}, "damping ratio of that low-pass");
  control.pressure_filter_s =
      reader.number("control.pressure_filter", {0.0, 2.0, "s"},
                    "low-pass of the load that the valve's model compensates");
  control.slow_error_m = reader.number("control.slow_error", {1e-3, 10.0, "m"},
                                       "path error at which the speed along the path is halved");
  read_learning(reader, control);
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
    safety.swing_uncommanded_rad = reader.number("safety.swing_uncommanded", {0.01, 1.0, "rad"},
                                                 "swing against its spool; only with valve.swing");
    safety.swing_stuck_rad =
        reader.number("safety.swing_stuck", {0.01, 1.0, "rad"},
                      "swing asked for that does not come; only with valve.swing");
  }
  safety.swash_tolerance = reader.number("safety.swash_tolerance", {0.01, 0.5, ""},
                                         "allowed error of a pump's swash, of full");
  safety.pressure_rail_pa = reader.number("sensors.pressure_range", {1e6, 1e8, "Pa"},
                                          "upper end of the pressure sensors");
  constexpr double kLeastAlive_s = 0.1;
  safety.levers_alive_s =
      reader.number_or(0.0, "safety.levers_alive", {0.0, 2.0, "s"},
                       "the operator's station changes what it sends of levers off their middle "
                       "at least so often, 0.1 s or more, as graben operate does; "
                       "0: it need not");
  if (safety.levers_alive_s > 0.0 && safety.levers_alive_s < kLeastAlive_s) {
    reader.fail("safety.levers_alive", fmt::format("{} s; allowed: 0, or five frames of levers, "
                                                   "{} s, and more",
                                                   safety.levers_alive_s, kLeastAlive_s));
  }
  return safety;
}

}  // namespace

DigPath read_path(TomlReader& reader, const std::string& at) {
  DigPath path;
  const std::vector<double> x = reader.numbers(at + ".x", {-30.0, 30.0, "m"}, 2,
                                               "least and most x of the path, from the boom foot");
  const std::vector<double> y = reader.numbers(at + ".y", {-30.0, 30.0, "m"}, 2,
                                               "least and most y of the path, from the boom foot");
  path.x_min_m = x[0];
  path.x_max_m = x[1];
  path.y_min_m = y[0];
  path.y_max_m = y[1];
  path.corner_radius_m =
      reader.number(at + ".corner_radius", {0.01, 10.0, "m"},
                    "radius of the path's corners; at most half the shorter side");
  const double half_side = 0.5 * std::min(path.x_max_m - path.x_min_m, path.y_max_m - path.y_min_m);
  if (!(half_side > 0.0)) {
    reader.fail(at, "x and y must each be given as [least, most]");
  } else if (path.corner_radius_m > half_side) {
    reader.fail(at + ".corner_radius", fmt::format("{} m; allowed: at most half the shorter side, "
                                                   "{} m",
                                                   path.corner_radius_m, half_side));
  }
  const auto attitude = reader.pairs(at + ".attitude", {-30.0, 30.0, "m"}, {-7.0, 7.0, "rad"}, 2, 2,
                                     "attitude of the bucket at both ends of x; linear between");
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
  const std::vector<double> position =
      reader.numbers(at + ".position", {-30.0, 30.0, "m"}, 3,
                     "teeth over the ground, from the swing axis: x forward, y to the left, z up");
  return {{position[0], position[1], position[2]},
          reader.number(at + ".attitude", {-7.0, 7.0, "rad"},
                        "attitude of the bucket: direction from the teeth to its pin")};
}

ExcavatorProfile read_excavator_sections(TomlReader& reader, const std::vector<KnownBus>& all) {
  ExcavatorProfile profile;
  profile.geometry = read_geometry(reader);
  profile.geometry.boom_foot_m = reader.point(
      "body.boom_foot", kPin, "boom foot pin: forward of the swing axis, above the ground");
  profile.geometry.body = read_outline(reader);
  profile.fence = read_fence_margins(reader);
  profile.drive_count = has_swing_drive(reader) ? kDriveCount : kAxisCount;
  profile.swing = read_swing(reader);
  profile.line = read_line(reader);
  profile.assist = read_assist(reader);
  read_pumps(reader, profile);
  profile.valve =
      read_valve(reader, profile.pump_count, profile.drive_count, profile.pump[0].regulator.kind);
  profile.control = read_control(reader);
  profile.dig_path = read_path(reader, "task.path");
  profile.dig_speed_mps =
      reader.number("task.speed", {0.01, 3.0, "m/s"}, "speed of the teeth along the path");
  read_swash(reader, profile);
  profile.oil = read_oil(reader);
  read_joint_sensors(reader, profile);
  check_law(reader, profile);
  profile.safety = read_safety(reader);
  profile.mark = read_mark(reader, profile.has_swing(),
                           "the mark, over the ground, from the swing axis: x forward, where the "
                           "machine swings y to the left, z up");
  profile.bus = read_bus(reader, shortest_dead_time_s(profile), all);
  return profile;
}

}  // namespace graben::machines
