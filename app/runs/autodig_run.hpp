// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A task of an excavator with swing in simulated time: plant, operator and controller as three
/// nodes on a bus in memory that exchange nothing but CAN frames.

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "app/machines/simulated/simulated_excavator.hpp"
#include "app/runs/as_built.hpp"
#include "app/runs/excavator_calm.hpp"
#include "app/runs/figures.hpp"
#include "app/runs/logged_run.hpp"
#include "firmware/excavator/motion/program/task_program.hpp"

namespace graben::runs {

struct AutodigOptions {
  DriveVector start = DriveVector::Zero();  ///< Strokes in m and swing in rad.
  double speed_override_ratio = 1.0;
  int rounds = 1;                  ///< Of a task that repeats.
  double word_after_s = 3.0;       ///< At a wait the operator asks for the task anew after so long.
  std::filesystem::path log_file;  ///< candump log; none if empty.
  std::string store;               ///< Folder for the controller's as-built record; none if empty.
  std::vector<std::string> faults;  ///< Of the machine, as told_fault() reads them.
  std::optional<double> most_s;     ///< Simulated time after which it is given up.
};

/// State at one control cycle. Not a number: unknown, or of no meaning there.
struct AutodigSample {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  double time_s = 0.0;
  TaskProgress progress;
  double progress_share = 0.0;      ///< Of the step.
  std::array<double, 3> teeth_m{};  ///< True, in the ground frame.
  double attitude_rad = 0.0;
  std::array<double, 3> planned_m{kUnknown, kUnknown, kUnknown};
  double planned_attitude_rad = kUnknown;
  double error_true_m = kUnknown;      ///< Of the teeth from the step's straight line.
  double error_measured_m = kUnknown;  ///< By what the controller was told.
  double end_off_true_m = kUnknown;    ///< Of the teeth from the step's end.
  double end_off_measured_m = kUnknown;
  double fence_left_m = kUnknown;  ///< Least of all points to all fences; below 0 beyond one.
  double over_cut_m = kUnknown;    ///< Of the edge's lower corner under the design; 0: none.
  double fill_m3 = kUnknown;       ///< Of the bucket, loose.
  double cut_m3 = kUnknown;        ///< Undisturbed soil that was cut, so far.
  double fill_kg = kUnknown;       ///< Of the bucket.
  /// Of the ground on the bucket, x outwards, z up, true; without the fill's weight.
  std::array<double, 2> tip_force_n{kUnknown, kUnknown};
  TipLoad told;  ///< By the controller, of both.
  double lambda = 0.0;
  Limit limit;
  /// Strokes in m, swing in rad; velocities m/s and rad/s, the wanted ones after lambda.
  std::array<double, kDriveCount> planned{kUnknown, kUnknown, kUnknown, kUnknown};
  std::array<double, kDriveCount> real{};
  std::array<double, kDriveCount> velocity_wanted{};
  std::array<double, kDriveCount> velocity_real{};
  std::array<double, kDriveCount> spool_command{};
  std::array<double, kDriveCount> spool_real{};
  std::array<double, kPumpCount> pump_expected_pa{};
  std::array<double, kPumpCount> pump_real_pa{};
  double swash_real = 0.0;  ///< Mean of the machine's pumps, of full swash.
  PumpEnergy energy;
  double cycle_us = 0.0;  ///< Computing time of the controller's cycle.
};

enum class AutodigEnd { kDone, kNotFinished, kFault };

struct AutodigResult {
  AutodigEnd end = AutodigEnd::kDone;
  Fault fault = Fault::kNone;            ///< With kFault.
  std::vector<std::string> faults_left;  ///< Of those that were told, as they were; not reached.
  int missed = 0;                        ///< See TaskProgress, at the run's end.
  std::vector<AutodigSample> samples;
  double wall_s = 0.0;
  std::uint32_t rejected_frames = 0;
  RealSpoolEdges spool_edges{};
  AsBuilt built;                                 ///< Of a task in layers, in ground that is cut.
  double capacity_kg = AutodigSample::kUnknown;  ///< Of the bucket, of the ground's soil, loose.
};

/// One step as it was done.
struct StepFigures {
  int step = 0;
  int round = 0;
  StepKind kind = StepKind::kNone;
  bool straight = false;
  double from_s = 0.0;
  double until_s = 0.0;
  double planned_s = 0.0;
  double max_error_true_m = 0.0;  ///< From its line, where it is one.
  double max_error_measured_m = 0.0;
  // Of the teeth from its end, when it was left; not a number of a step that is dug in layers.
  double end_error_true_m = kAbsent;
  double end_error_measured_m = kAbsent;  ///< By what the controller was told.
  /// False: the controller went on though the teeth had not come to stand at its end.
  bool arrived = true;
  UntilKind ended_by = UntilKind::kEnd;  ///< Other than kEnd: it has no end to be off.
};

struct AutodigSummary {
  double max_error_true_m = 0.0;  ///< Of all straight steps, like the next ones.
  double rmse_error_true_m = 0.0;
  double max_error_measured_m = 0.0;
  double rmse_error_measured_m = 0.0;
  double end_error_true_m = 0.0;  ///< Of a straight step, largest.
  double raised_max_m = kAbsent;  ///< Of the ends of digs, by the design, as planning tells it.
  double move_end_error_true_m = kAbsent;  ///< The same of the moves of the drives.
  int not_arrived = 0;        ///< Steps, and the approach, that went on without having arrived.
  double fence_left_m = 0.0;  ///< Least; not a number without fences.
  /// Deepest that a corner of the true edge was under the design; not a number without a design.
  double over_cut_max_m = kAbsent;
  // Of a ground that is cut, else not a number.
  double energy_per_m3_j = kAbsent;
  AsBuilt built;
  double cut_m3 = kAbsent;       ///< Undisturbed.
  double cut_m3ph = kAbsent;     ///< The same, of the time of the steps.
  double fill_max_m3 = kAbsent;  ///< Loose, in the bucket.
  /// Of the rounds that dump, those whose bucket swung there with 90 % of its capacity or more.
  double full_rounds_ratio = kAbsent;
  /// Of the tip force that the controller tells, while it digs: share of the time in which it is
  /// within a tenth of the largest true one; its error, RMS of both components together; and that
  /// over the deviation it tells.
  double tip_force_within_ratio = kAbsent;
  double tip_force_error_n = kAbsent;
  double tip_force_spread = kAbsent;
  /// True force against the line of a cut in layers, over the one that its plan allows: RMS of the
  /// time that it cuts, in which less counts as none, and largest.
  double cut_force_over_n = kAbsent;
  double cut_force_over_max_n = kAbsent;
  /// Of the payload as it was told last before each dump, from the second one on, when the empty
  /// bucket has been back once: largest error, of the bucket's heaped capacity of this soil
  /// loose, share of them that are within 2 % of it, and RMS of error over deviation.
  double payload_error_ratio = kAbsent;
  double payload_within_ratio = kAbsent;
  double payload_spread = kAbsent;
  double lambda_min = 0.0;  ///< From the first step on.
  double lambda_mean = 0.0;
  double task_s = 0.0;     ///< From the first step's begin to the last one's end.
  double planned_s = 0.0;  ///< Of all these steps.
  ExcavatorCalm calm;      ///< In steps; the teeth work.
  double energy_per_round_j = kAbsent;
  RunPace pace;
  std::vector<StepFigures> steps;
  LimitShares limit_share;  ///< See logged_limit_shares(); empty without a log.
};

/// Runs the task until it is done, something fails, or ten times the planned time is over. The same
/// machine and options give the same samples (but cycle_us) and the same bytes in the log.
[[nodiscard]] AutodigResult run_autodig(const machines::SimulatedExcavator& machine,
                                        const TaskProgram& program, const AutodigOptions& options,
                                        const Progress& progress);

[[nodiscard]] AutodigSummary summarise(const TaskProgram& program, const AutodigResult& result);
[[nodiscard]] const FigureTable<AutodigSummary>& autodig_figures();
[[nodiscard]] inline RunFigures figures_of(const AutodigSummary& summary) {
  return figures_of(autodig_figures(), summary, "share of time active per limit of lambda");
}
/// The same for who reads one run: of an area what was made of it stands first.
[[nodiscard]] RunFigures headed_figures(const AutodigSummary& summary);

/// A line for each step as it was done.
[[nodiscard]] std::string steps_text(const AutodigSummary& summary);

}  // namespace graben::runs
