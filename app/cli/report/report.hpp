#pragma once
/// The report of a simulated run: one HTML file that opens from disk without a network.
///
/// The data is one JSON object. The page checks it part by part: a part that is missing or
/// malformed is replaced by a sentence that names it, the rest is shown. Units are those of the
/// core (SI), the page converts. A value that is not finite becomes null in JSON, and a gap in the
/// plot. Up to about 30 000 samples stay fluent.
///
/// Of every kind of run:
///   kind          "grade", "plan" or "autodig"; a digging run where it is missing
///   title         string
///   subtitle      string: profile, seed, command line
///   summary       [{label, value, unit, note?}]: key figures; value is a number or a string
///   limits_share  [{name, share}]: share of time, 0 to 1, for each active limit; "none" is free
///   series        lists of equal length, one value a sample, unless noted
///     time_s                  never falls
///     lambda                  0 to 1
///     limit                   index into limit_names
///     limit_names             [string], not a series; "none" is free
///     cycle_time_us           optional: computing time of a control cycle
///
/// Of a digging run:
///   geometry
///     path          [[x, y]] m, closed: the last point joins the first
///     tip_true      [[x, y]] m; with as many points as time_s, a dot follows the plots' cursor
///     tip_measured  [[x, y]] m; a point with null is left out
///     field         [[x, y, vx, vy]] m, m/s, on a regular grid; may be empty
///     ground_y_m    number or null
///     marks         [{x, y, attitude_deg, time_s}], one every 5 s
///     start         [x, y] m
///   series
///     spool_command           [boom, arm, bucket], each -1 to 1 of the travel
///     spool_real              the same
///     velocity_wanted         [boom, arm, bucket] m/s: lambda V_L^d
///     velocity_real           [boom, arm, bucket] m/s
///     pump_pressure_expected  one list a pump (1 to 3), Pa
///     pump_pressure_real      the same
///     error_true_m            distance of the true tip from the path
///     error_measured_m        the same, of the measured tip
///
/// Of a grading run, drawn over the way of the cutting edge:
///   speed_mode    "bounded" or "constant"
///   terrain       [[x, z]] m, as it was left; x never falls
///   series
///     edge_x_m, edge_z_m      true cutting edge
///     body_x_m, body_z_m      true body, at the tracks' ground line
///     pitch_rad               nose up
///     design_m                height of the design at the edge
///     error_true_m            edge over the design, straight up
///     error_measured_m        the same, of the measured edge
///     speed_wanted_mps        v_c of (14)
///     speed_true_mps, speed_measured_mps
///     speed_limit_mps         (14) without v_d
///     speed_desired_mps       v_d, a number
///     flow_required_m3ps      (7), for the true motion to follow the design
///     flow_reported_m3ps      the same as the controller has it
///     flow_available_m3ps
///     blade_wanted_mps, blade_true_mps   of the blade cylinders
///     spool_command, spool_real          -1 to 1 of the travel
///     track_mps               [left, right]
///     pump_command, pump_real, motor_command, motor_real   [left, right], of full displacement
///
/// Of a planned line, which has neither limits nor lambda:
///   series
///     way_m, speed_mps        of the teeth along the line
///     teeth_m                 [x, y, z]
///     attitude_rad
///     displacement, velocity, acceleration   [boom, arm, bucket, swing]: m or rad, by s
///
/// Of a task's run by an excavator with swing; each number null where it is not known:
///   steps         [{name, kind, from_s, until_s, from_m, to_m}]: kind "line" (of the teeth) or
///                 "drives" (straight in drive space); from_m and to_m [x, y, z] of the planned
///                 teeth. Without from_s it has not begun, without until_s it lasts to the end
///   fences        [{words}]: what the machine may not pass; may be empty
///   design        null or {words}: the surface to dig to
///   series
///     teeth_m, planned_m      [x, y, z]: true and planned; x forward, y left, z up, from the swing
///                             axis on the ground
///     attitude_rad, planned_attitude_rad
///     error_true_m            distance of the true teeth from the step's line; null without one
///     error_measured_m        the same, of the measured teeth
///     progress                of the step, 0 to 1
///     planned, real           [boom, arm, bucket, swing] m, rad: strokes and angle
///     velocity_wanted, velocity_real   the same, by s; wanted after lambda
///     spool_command, spool_real        the same, each -1 to 1 of the travel
///     pump_expected_pa, pump_real_pa   one list a pump

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace graben::cli {

/// Writes the report beside `file` and renames it into place, so that whatever goes wrong, `file`
/// is either the complete new report or what it was before.
/// Throws std::runtime_error, naming the file and the reason, when it cannot be written.
void write_report(const std::filesystem::path& file, const nlohmann::json& data);

}  // namespace graben::cli
