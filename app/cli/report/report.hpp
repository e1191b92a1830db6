#pragma once
/// The report of a simulated run: one HTML file that opens from disk without a network.
///
/// The data is one JSON object. The page checks it part by part: a part that is missing or
/// malformed is replaced by a sentence that names it, the rest is shown. Units are those of the
/// core (SI), the page converts. A value that is not finite becomes null in JSON, and a gap in the
/// plot. Up to about 30 000 samples stay fluent.
///
///   title         string
///   subtitle      string: profile, seed, command line
///   summary       [{label, value, unit, note?}]: key figures; value is a number or a string
///   limits_share  [{name, share}]: share of time, 0 to 1, for each active limit; "none" is free
///   geometry
///     path          [[x, y]] m, closed: the last point joins the first
///     tip_true      [[x, y]] m; with as many points as time_s, a dot follows the plots' cursor
///     tip_measured  [[x, y]] m; a point with null is left out
///     field         [[x, y, vx, vy]] m, m/s, on a regular grid; may be empty
///     ground_y_m    number or null
///     marks         [{x, y, attitude_deg, time_s}], one every 5 s
///     start         [x, y] m
///   series        lists of equal length, one value a sample, unless noted
///     time_s                  never falls
///     lambda                  0 to 1
///     limit                   index into limit_names
///     limit_names             [string], not a series; "none" is free
///     spool_command           [boom, arm, bucket], each -1 to 1 of the travel
///     spool_real              the same
///     velocity_wanted         [boom, arm, bucket] m/s: lambda V_L^d
///     velocity_real           [boom, arm, bucket] m/s
///     pump_pressure_expected  one list a pump (1 to 3), Pa
///     pump_pressure_real      the same
///     error_true_m            distance of the true tip from the path
///     error_measured_m        the same, of the measured tip
///     cycle_time_us           optional: computing time of a control cycle

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace graben::cli {

/// Writes the report beside `file` and renames it into place, so that whatever goes wrong, `file`
/// is either the complete new report or what it was before.
/// Throws std::runtime_error, naming the file and the reason, when it cannot be written.
void write_report(const std::filesystem::path& file, const nlohmann::json& data);

}  // namespace graben::cli
