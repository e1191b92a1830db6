// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <tuple>
#include <utility>

#include "app/machines/blade_answers.hpp"
#include "app/machines/bus_key.hpp"
#include "app/machines/dozer_sections.hpp"
#include "app/machines/mark_section.hpp"
#include "app/machines/shared_sections.hpp"
#include "app/machines/tilt_section.hpp"

namespace graben::machines {
namespace {

constexpr Range kPin{-5.0, 5.0, "m"};
constexpr Range kEfficiency{0.5, 1.0, ""};
constexpr Range kDisplacement{1e-6, 1e-2, "m3/rev"};
constexpr Range kEngine{20.0, 400.0, "rad/s"};
constexpr Range kX{-1000.0, 1000.0, "m"};
constexpr Range kHeight{-100.0, 100.0, "m"};

/// Both ends of a range, the least first.
std::pair<double, double> read_ends(TomlReader& reader, const std::string& key, const Range& range,
                                    const char* help) {
  const std::vector<double> ends = reader.numbers(key, range, 2, help);
  if (ends[0] > ends[1]) {
    reader.fail(key, fmt::format("[{}, {}] {}; must be given as [least, most]", ends[0], ends[1],
                                 range.unit));
  }
  return {ends[0], ends[1]};
}

DozerBody read_body(TomlReader& reader) {
  DozerBody body;
  body.mass_kg = reader.number("body.mass", {500.0, 1e5, "kg"}, "mass of the whole machine");
  body.mass_centre_height_m = reader.number("body.mass_centre_height", {0.1, 3.0, "m"},
                                            "mass centre above the tracks' ground line");
  body.pitch_inertia_kgm2 = reader.number("body.pitch_inertia", {10.0, 1e6, "kg m2"},
                                          "moment of inertia in pitch, blade included");
  body.wheels =
      reader.integer("body.wheels", 2, kMostWheels, "wheels per track of the half-vehicle model");
  body.track_contact_m =
      reader.number("body.track_contact", {0.5, 6.0, "m"}, "first to last wheel");
  body.half_gauge_m =
      reader.number("body.half_gauge", {0.3, 3.0, "m"}, "centre line to the middle of a track");
  body.suspension_npm =
      reader.number("body.suspension.stiffness", {1e4, 1e8, "N/m"},
                    "spring of each wheel of the half-vehicle, push only; sags by at most 0.1 m");
  body.suspension_nspm = reader.number("body.suspension.damping", {0.0, 1e7, "N s/m"},
                                       "damper of each wheel of the half-vehicle");
  return body;
}

BladeGeometry read_blade(TomlReader& reader) {
  BladeGeometry blade;
  blade.pivot_m = reader.point("blade.pivot", kPin, "pivot of the blade's frame, body frame: x, z");
  blade.arm_m = reader.point(
      "blade.arm", kPin, "pivot to the blade's foot at home: x, z; the rod eye lies on this line");
  blade.cutting_edge_m =
      reader.number("blade.cutting_edge", {0.3, 5.0, "m"}, "pivot to cutting edge");
  const CylinderSize size = read_cylinder_size(reader, "blade.cylinder");
  blade.cylinder_count = size.count;
  blade.bore_m = size.bore_m;
  blade.rod_m = size.rod_m;
  blade.base_m = reader.point("blade.cylinder.base", kPin,
                              "base pin of the blade cylinders, body frame: x, z");
  blade.length_home_m = reader.number("blade.cylinder.length_home", {0.1, 5.0, "m"},
                                      "pin to pin where the cutting edge is at the ground line");
  std::tie(blade.edge_min_m, blade.edge_max_m) =
      read_ends(reader, "blade.range", {-2.0, 3.0, "m"},
                "lowest and highest cutting edge against the ground line, body level");
  return blade;
}

ImplementProfile read_implement(TomlReader& reader) {
  ImplementProfile implement;
  implement.displacement_m3prev =
      reader.number("implement.pump.displacement", kDisplacement, "implement pump, on the engine");
  implement.efficiency =
      reader.number("implement.pump.volumetric_efficiency", kEfficiency, "implement pump, at work");
  implement.valve_flow_max_m3ps = reader.number("implement.valve_flow_max", {1e-5, 0.1, "m3/s"},
                                                "flow through the fully open spool");
  implement.spool_to_duty = read_spool_to_duty(reader, "implement.spool_to_duty");
  return implement;
}

HstProfile read_hst(TomlReader& reader) {
  HstProfile hst;
  hst.engine_radps = reader.number("hst.engine_speed", kEngine, "engine at work");
  std::tie(hst.engine_least_radps, hst.engine_most_radps) =
      read_ends(reader, "hst.engine_range", kEngine, "slowest and fastest engine");
  hst.pump_m3prev =
      reader.number("hst.pump_displacement", kDisplacement, "travel pump of one track");
  hst.motor_m3prev =
      reader.number("hst.motor_displacement", kDisplacement, "travel motor of one track");
  hst.motor_ratio_min = reader.number("hst.motor_ratio_min", {0.05, 1.0, ""},
                                      "least displacement of the motor, of full");
  hst.gear_ratio = reader.number("hst.gear_ratio", {1.0, 500.0, ""}, "motor to sprocket");
  const std::vector<double> efficiency =
      reader.numbers("hst.efficiency", kEfficiency, 2, "volumetric, of pump and motor, at work");
  hst.pump_efficiency = efficiency[0];
  hst.motor_efficiency = efficiency[1];
  hst.sprocket_radius_m =
      reader.number("hst.sprocket_radius", {0.1, 1.5, "m"}, "sprocket's pitch radius");
  hst.pump_rate_ps = reader.number("hst.pump_rate", {0.1, 100.0, "1/s"},
                                   "fastest change of the pump's displacement, of full");
  hst.motor_rate_ps = reader.number("hst.motor_rate", {0.1, 100.0, "1/s"},
                                    "fastest change of the motor's displacement, of full");
  // The pump's: it alone follows the speed at work, the motor only above what the pump gives.
  hst.response_s = reader.number("hst.pump_response", {0.001, 2.0, "s"},
                                 "first-order lag of the pump's displacement behind its command");
  return hst;
}

TravelProfile read_travel(TomlReader& reader) {
  const Range rate{0.05, 5.0, "m/s2"};
  TravelProfile travel;
  travel.speed_desired_mps =
      reader.number("travel.speed_desired", {0.05, 3.0, "m/s"}, "travel speed wanted, v_d");
  travel.speed_min_mps =
      reader.number("travel.speed_min", {0.01, 1.0, "m/s"},
                    "least speed that a limit may ask for, v_min; at most speed_desired");
  travel.acceleration_max_mps2 =
      reader.number("travel.acceleration_max", rate, "change of the travel speed (Algorithm 1)");
  travel.threshold_rad =
      reader.number("travel.threshold", {0.0, 0.5, "rad"},
                    "pitch from which the speed is lowered (Algorithm 1, theta_threshold)");
  travel.deceleration_max_mps2 = reader.number("travel.deceleration_max", {0.1, 1.2, "m/s2"},
                                               "braking that the speed ahead is planned with");
  travel.flow_share = reader.number("travel.flow_share", {0.1, 1.0, ""},
                                    "share of the available implement flow that is planned with");
  travel.preview_m =
      reader.number("travel.preview", {1.5, 3.5, "m"}, "how far ahead the ground is looked at");
  travel.push_max_n = reader.number("travel.push_max", {1e3, 1e6, "N"},
                                    "most that the tracks push with against the blade's load, "
                                    "above which the blade rises");
  travel.track_gain = reader.number("travel.track_gain", {0.0, 10.0, ""},
                                    "proportional part of a track's speed controller, m/s to m/s");
  travel.track_integral_ps = reader.number("travel.track_integral", {0.0, 50.0, "1/s"},
                                           "integral part of a track's speed controller");
  if (travel.speed_min_mps > travel.speed_desired_mps) {
    reader.fail("travel.speed_min", fmt::format("{} m/s; allowed: at most speed_desired, {} m/s",
                                                travel.speed_min_mps, travel.speed_desired_mps));
  }
  return travel;
}

GradeDesign read_grade(TomlReader& reader) {
  GradeDesign grade;
  if (reader.has(kDesignKey)) {
    static_cast<void>(design_name(reader));
  } else {
    for (const auto& [x_m, z_m] : reader.pairs(
             "grade.profile", kX, kHeight, 2, GradeDesign::kMostPoints,
             "corners of the design, x and height over the plane; x rises, slopes up to 0.6")) {
      grade.point[static_cast<unsigned>(grade.count++)] = {x_m, z_m};
    }
  }
  grade.rounding_m = reader.number("grade.rounding", {0.0, 10.0, "m"},
                                   "from each corner to where its curve begins, either side");
  grade.plane_height_m = reader.number("grade.plane_height", kHeight, "design plane at x = 0");
  grade.plane_slope =
      reader.number("grade.plane_slope", {-0.3, 0.3, ""}, "slope dz/dx of the design plane");
  grade.ground_m =
      reader.number("grade.ground", kHeight, "the ground that is there, over the plane");
  grade.pass_depth_m = reader.number(
      "grade.pass_depth", {0.02, 10.0, "m"},
      "so deep goes the first pass; each next one as much deeper as its force allows");
  grade.passes_most = reader.integer("grade.passes", 1, 50,
                                     "most passes: what a pass has to leave is gone back for");
  grade.tolerance_m =
      reader.number("grade.tolerance", {0.005, 0.1, "m"},
                    "how far off the design the ground may come out; the speed is what keeps it");
  return grade;
}

DozerControl read_control(TomlReader& reader) {
  auto control = read_control_of_valve<DozerControl>(reader, "implement");
  control.pose_latency_s = reader.number("control.pose_latency", {0.0, 0.2, "s"},
                                         "age of a measured pose when it comes in");
  control.blade_gain_ps = reader.number("control.blade_gain", {0.0, 50.0, "1/s"},
                                        "height error of the cutting edge to its velocity");
  control.blade_integral_ps2 = reader.number("control.blade_integral", {0.0, 100.0, "1/s2"},
                                             "integral part of the blade controller");
  control.blade_integral_most_mps =
      reader.number("control.blade_integral_most", {0.0, 1.0, "m/s"}, "bound of the integral part");
  if (reader.lists() || reader.has("control.learns")) {
    control.learns = reader.boolean_or(
        true, "control.learns",
        "the share that the pump gives and the tracks' slip in turns are learnt at work; false: "
        "both are as told");
  }
  return control;
}

DozerSafety read_safety(TomlReader& reader) {
  auto safety = read_safety_of_valve<DozerSafety>(reader);
  safety.displacement_tolerance = reader.number("safety.displacement_tolerance", {0.01, 0.5, ""},
                                                "allowed error of a displacement, of full");
  safety.displacement_settle_s =
      reader.number("safety.displacement_settle", {0.01, 2.0, "s"},
                    "time within which a displacement reaches its command");
  safety.track_speed_tolerance_mps =
      reader.number("safety.track_speed_tolerance", {0.01, 2.0, "m/s"},
                    "allowed error of a track's speed against what its displacements give");
  return safety;
}

}  // namespace

std::string design_name(TomlReader& reader) {
  return reader.text(kDesignKey,
                     "the design in a file of its own, by its name beside this file, instead of "
                     "grade.profile: a line a corner, x and height over the plane, m, "
                     "and where the blade tilts the slope across and the track's curvature");
}

DozerProfile read_dozer_sections(TomlReader& reader) {
  DozerProfile profile;
  profile.body = read_body(reader);
  profile.blade = read_blade(reader);
  profile.tilt = read_tilt(reader);
  profile.implement = read_implement(reader);
  profile.hst = read_hst(reader);
  profile.travel = read_travel(reader);
  profile.grade = read_grade(reader);
  profile.control = read_control(reader);
  profile.safety = read_safety(reader);
  profile.mark = read_mark(reader, false,
                           "the mark, in the world of the design: x along it, z up; the middle of "
                           "the cutting edge is set to it");
  read_blade_answers(reader, profile);
  profile.bus = read_bus(reader, profile.control.dead_time_s);
  return profile;
}

}  // namespace graben::machines
