// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The hydraulic drives of a machine, one row each: all that the common rooms know of a drive. A
/// kind makes its rows once, at start, from its profile. What is said of a cylinder holds for a
/// motor too, as travel, area and speed at a lever. SI units; extension is positive.

#include <algorithm>
#include <array>

#include "firmware/core/codes.hpp"
#include "firmware/core/span.hpp"
#include "firmware/machine/spool_answer.hpp"
#include "firmware/machine/tuning.hpp"
#include "firmware/machine/valve.hpp"

namespace graben {

/// Drives that a machine can have. [-; size: rows of a bank; an excavator has 4]
inline constexpr int kMostDrives = 6;

/// How a drive's commands may change.
struct DriveControl {
  double spool_rate_ps = 0.0;          ///< Largest change of |x| / x_m per second.
  double duty_rate_ps = kDutyRate_ps;  ///< Largest rise of a duty on the wire per second.
  double spool_threshold = 0.0;        ///< |x| / x_m under which the spool is kept at neutral.
  double stroke_end_gain_ps = 0.0;  ///< Largest speed towards an end of the travel, per metre left.
  double end_slack_m = 0.0;         ///< See approach_ends().
  double deceleration_mps2 = 0.0;   ///< That the drive is stopped with before an end.
  Limit at_end{LimitKind::kStrokeEnd, 0};  ///< Reported where an end of the travel slows.
  bool has_end_stops = true;  ///< Nothing takes the drive beyond the ends of its travel.
  bool holds_itself = false;  ///< Closed, its spool needs no correction to hold the drive.
  bool learns = true;         ///< What its valve turns out to be is learnt at work.
  double learn_share = 1.0;   ///< Of the pace at which it would be learnt of a machine as found.
};

/// Feedback around the valve's model, see drive_servo.hpp.
struct DriveFeedback {
  double gain_ps = 0.0;        ///< Integrated error of the travel to speed.
  double error_most_m = 0.0;   ///< Bound of the integrator.
  double plan_most_m = 0.0;    ///< The same while a plan is followed.
  double least_lambda = 1.0;   ///< Corrections have their full authority down to this lambda.
  double frequency_hz = 0.0;   ///< Of the correction's low-pass; undamped.
  double damping = 0.0;        ///< Its damping ratio.
  double bias_ps2 = 0.0;       ///< How fast a lasting lag is learnt, per second and second.
  double bias_most_mps = 0.0;  ///< No more than this is learnt.
};

/// Bounds that a healthy drive and its sensors keep.
struct DriveWatch {
  double fastest_mps = 0.0;     ///< Faster than this the drive never moves.
  double jump_margin_m = 0.0;   ///< At once: noise, and frames that were lost.
  double sensed_least_m = 0.0;  ///< Range into which the stroke is taken ...
  double sensed_most_m = 0.0;
  double sensed_margin_m = 0.0;  ///< ... and how far beyond it is implausible: bias, mounting.
  bool senses_load = true;       ///< Pressures of both sides are measured.
  bool senses_spool = true;      ///< Its position is; else it counts as where it was sent.
  /// By so much a spool may be behind what is told of it; 0: it is measured.
  double spool_late_s = 0.0;
  double settle_s = 0.0;         ///< How far a sound spool may lag its duty beside the dead time.
  double spool_tolerance = 0.0;  ///< Of the spool's travel.
  double uncommanded_m = 0.0;    ///< Way that the drive may go where its spool does not lead.
  double wrong_m = 0.0;          ///< Way against its spool, pushed by its oil; 0: not watched.
  double stuck_m = 0.0;          ///< Asked of a drive whose stroke stands still.
  // 0: its flow is not watched.
  double unseen_m = 0.0;          ///< That its oil moves a drive whose stroke stands still.
  double off_m = 0.0;             ///< Of a stroke from all that its oil can have done.
  double way_m = 0.0;             ///< Of a stroke from what was asked; 0: not watched.
  double still_mps = 0.0;         ///< Below it a motor stands; of a motor only.
  double leak_mpspa = 0.0;        ///< Speed that it may lose by its own leakage, per pressure.
  double rest_s = 0.0;            ///< Until it has come to rest after its spool has closed.
  double rest_m = kRestMoved_m;   ///< Way that it may go when nobody asks it to.
  double brakes_s = 0.0;          ///< Half of the time that it takes to brake from its full speed.
  double sink_mps = 0.0;          ///< No faster it sinks, with its spool in its middle.
  double relief_pa = 0.0;         ///< Of the pump's line; 0: none, or not known.
  double pressure_rail_pa = 0.0;  ///< Where the pressure sensors end.
};

/// Of a valve whose inlet meters the flow whatever the load, and its pump; without one the metering
/// edges make the flow.
struct DriveSupply {
  double valve_flow_m3ps = 0.0;  ///< At full opening; 0: metering edges.
  double pump_m3prad = 0.0;      ///< Per radian of the engine.
};

struct DriveRow {
  double least_travel_m = 0.0;
  double most_travel_m = 0.0;
  double extend_area_m2 = 0.0;  ///< Area that extends the drive, all its cylinders together.
  double retract_area_m2 = 0.0;
  SpoolProfile spool;
  SpoolMetering metering;
  DriveSupply supply;
  SpoolAnswers answer;
  DriveControl control;
  DriveFeedback feedback;
  DriveWatch watch;
};

/// Its valve's edges meter the flow; else the valve's inlet does, whatever the load.
[[nodiscard]] inline bool has_edges(const DriveRow& drive) {
  return drive.supply.valve_flow_m3ps == 0.0;
}

/// Share of a spool's `settle_s` that each of its two lags has. [-; derived: kLateShare; a steady
/// rise the spool so follows by just settle_s later]
inline constexpr double kLagShare = (1.0 - kLateShare) / 2.0;

/// Longest time from a duty to the spool's first movement, of both sides, s.
[[nodiscard]] inline double longest_dead_time_s(const DriveRow& drive) {
  return kTimeBand * std::max(drive.answer.extend.dead_time_s, drive.answer.retract.dead_time_s);
}

/// Until a sound spool starts after its command at the latest, s.
[[nodiscard]] inline double spool_starts_s(const DriveRow& drive) {
  return longest_dead_time_s(drive) + kLateShare * drive.watch.settle_s;
}

/// Longest of each of the two lags with which it then follows, s.
[[nodiscard]] inline double spool_lag_s(const DriveRow& drive) {
  return kLagShare * drive.watch.settle_s;
}

/// Time by which it may be behind its command, s.
[[nodiscard]] inline double spool_arrives_s(const DriveRow& drive) {
  return longest_dead_time_s(drive) + drive.watch.settle_s;
}

using DriveRows = Span<const DriveRow>;

/// Rows of a kind that has up to `kMost` drives.
template <int kMost>
struct DriveBank {
  static_assert(kMost >= 1 && kMost <= kMostDrives);

  std::array<DriveRow, kMost> row;
  int count = kMost;

  [[nodiscard]] DriveRows rows() const { return {row.data(), count}; }
};

/// Travel and sensed range of a cylinder of this stroke, with its margins (tuning.hpp).
inline void set_cylinder_range(double stroke_m, DriveRow& row) {
  row.most_travel_m = stroke_m;
  row.watch.sensed_most_m = stroke_m;
  row.watch.sensed_margin_m = kStrokeMargin_m;
  row.watch.jump_margin_m = kJumpMargin_m;
}

/// Until a cylinder has come to rest after its spool's command has closed: its oil rings down, and
/// a spool that is not measured has to arrive first.
[[nodiscard]] inline double rest_s(const DriveRow& row) {
  return kCylinderRest_s + (row.watch.senses_spool ? 0.0 : spool_arrives_s(row));
}

}  // namespace graben
