// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The grading task in simulated time: plant, operator and controller as three nodes on a bus in
/// memory that exchange nothing but CAN frames.

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/machines/simulated/simulated_dozer.hpp"
#include "app/runs/figures.hpp"
#include "app/runs/grade_truth.hpp"
#include "app/runs/logged_run.hpp"

namespace graben::runs {

struct GradeOptions {
  double speed_override_ratio = 1.0;
  std::filesystem::path log_file;   ///< candump log; none if empty.
  std::vector<std::string> faults;  ///< Of the machine, as told_fault() reads them.
  std::optional<double> most_s;     ///< Simulated time after which it is given up.
};

/// State at one control cycle, true and as the controller has it. What is measured is not a number
/// until it was received; flows are magnitudes.
struct GradeSample {
  double time_s = 0.0;
  int pass = 1;  ///< Over the grade.
  /// The cutting edge is over the grade, from x = 0 to its length, and not on its way back.
  bool over_grade = false;
  BodyPose body;
  Eigen::Vector2d edge_m = Eigen::Vector2d::Zero();  ///< True, world.
  double design_m = 0.0;                             ///< The design's height at the edge.
  double error_true_m = 0.0;  ///< Edge over the design, straight up; its worse end if it tilts.
  double tilt_rad = 0.0;      ///< True.
  double off_track_m = 0.0;   ///< Of the edge's middle, in plan, left of a track that curves.
  double error_measured_m = std::nan("");
  double speed_wanted_mps = 0.0;  ///< v_c of (14)
  double speed_true_mps = 0.0;
  double speed_measured_mps = std::nan("");
  double speed_limit_mps = 0.0;  ///< (14) without v_d.
  double lambda = 0.0;
  Limit limit;
  double flow_required_m3ps =
      0.0;  ///< (7), tilt included, for the true motion to follow the design.
  double flow_available_m3ps = 0.0;  ///< Of the true machine.
  double flow_reported_m3ps = 0.0;   ///< The controller's (7).
  double flow_limit_reported_m3ps = 0.0;
  double blade_wanted_mps = 0.0;
  double blade_true_mps = 0.0;
  double spool_command = 0.0;  ///< Of its travel; extension is positive.
  double spool_real = 0.0;
  std::array<double, kTrackCount> track_mps{};  ///< True, of the tracks.
  std::array<double, kTrackCount> pump_command{};
  std::array<double, kTrackCount> pump_real{};
  std::array<double, kTrackCount> motor_command{};
  std::array<double, kTrackCount> motor_real{};
  double cycle_us = 0.0;  ///< Computing time of the controller's cycle.
};

enum class GradeEnd { kDone, kNotFinished, kFault };

struct GradeResult {
  GradeEnd end = GradeEnd::kDone;
  Fault fault = Fault::kNone;            ///< With kFault.
  std::vector<std::string> faults_left;  ///< Of those that were told, as they were; not reached.
  std::vector<GradeSample> samples;
  std::vector<Eigen::Vector2d> terrain_m;  ///< As it was left, x and z.
  std::vector<Eigen::Vector3d> ends_m;     ///< The same below the ends of an edge that tilts.
  double wall_s = 0.0;
  std::uint32_t rejected_frames = 0;
};

/// Figures of the time during which the cutting edge was over the grade.
struct GradeSummary {
  double max_error_true_m = 0.0;  ///< Magnitude.
  double rmse_error_true_m = 0.0;
  double max_error_measured_m = 0.0;
  double rmse_error_measured_m = 0.0;
  double time_s = 0.0;  ///< The edge's from x = 0 to the grade's length, all passes.
  int passes = 1;
  double off_track_m = 0.0;    ///< Edge's middle beside a track that curves, magnitude, max.
  double ground_left_m = 0.0;  ///< Most that the ground stands above the design in the end.
  double over_cut_m = 0.0;     ///< And below it.
  double halt_s = 0.0;         ///< Longest time that it did not get on in a pass.
  double mean_speed_mps = 0.0;
  double flow_share_max = 0.0;  ///< Largest of required over available, of the true motion.
  double flow_share_reported_max = 0.0;  ///< The same as the controller had it.
  double flow_above_share = 0.0;         ///< Of the time: required is above available.
  /// Stretches above it; what is less than kOccasion_m further on belongs to the same one.
  int flow_occasions = 0;
  double deceleration_wanted_mps2 = 0.0;  ///< Largest of v_c, from cycle to cycle.
  double deceleration_true_mps2 = 0.0;    ///< Largest mean over kDeceleration_s, of the body.
  /// Of the slope of v_c; it counts as turned when v_c has gone kSpeedResolution_mps back.
  int sign_changes = 0;
  int corners = 0;  ///< Of the design between its ends.
  double lambda_variation_ps = 0.0;
  double spool_travel_ps = 0.0;  ///< Of the blade's real spool, like the next.
  double spool_reversals_ps = 0.0;
  double edge_jerk_rms_mps3 = 0.0;  ///< Of the true edge, see Jerk.
  RunPace pace;
  LimitShares limit_share;  ///< See logged_limit_shares(); empty without a log.
};
inline constexpr double kOccasion_m = 0.5;
inline constexpr double kDeceleration_s = 0.1;
inline constexpr double kSpeedResolution_mps = 0.02;

/// Runs until the cutting edge has come to the grade's length, something fails, or the time is
/// over: ten times what the wanted speed needs, and 20 s. The same machine and options give the
/// same samples (but cycle_us) and the same bytes in the log.
[[nodiscard]] GradeResult run_grade(const machines::SimulatedDozer& machine,
                                    const GradeOptions& options, const Progress& progress);

[[nodiscard]] GradeSummary summarise(const machines::SimulatedDozer& machine,
                                     const GradeResult& result);
[[nodiscard]] const FigureTable<GradeSummary>& grade_figures();
[[nodiscard]] inline RunFigures figures_of(const GradeSummary& summary) {
  return figures_of(grade_figures(), summary, "share of time active per limit of the speed");
}
/// The same for who reads one run: of a job in passes what it leaves stands first.
[[nodiscard]] RunFigures headed_figures(const GradeSummary& summary);

/// What is left out of the design's tolerance, with its figures; empty: nothing is.
[[nodiscard]] std::string out_of_tolerance(const GradeSummary& summary, double tolerance_m);

}  // namespace graben::runs
