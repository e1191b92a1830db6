// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The digging task in simulated time: plant, operator and controller as three nodes on a bus in
/// memory that exchange nothing but CAN frames.

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/machines/simulated/simulated_excavator.hpp"
#include "app/runs/excavator_calm.hpp"
#include "app/runs/figures.hpp"
#include "app/runs/logged_run.hpp"
#include "firmware/excavator/kinematics/excavator_kinematics.hpp"

namespace graben::runs {

struct DigOptions {
  Eigen::Vector3d start_strokes_m = Eigen::Vector3d::Zero();
  double speed_override_ratio = 1.0;
  double loops = 1.0;               ///< Times round the path once it is reached.
  double approach_max_s = 90.0;     ///< To reach the path.
  double loop_max_s = 120.0;        ///< For each time round it.
  std::filesystem::path log_file;   ///< candump log; none if empty.
  std::vector<std::string> faults;  ///< Of the machine, as told_fault() reads them.
};

/// A period of the lowest mode of the linkage on its oil.
inline constexpr double kOilPeriod_s = 0.36;

enum class Obstruction { kNone, kHolding, kReleased };

/// State at one control cycle, true and as the controller has it.
struct DigSample {
  double time_s = 0.0;
  bool on_path =
      false;  ///< The path was reached and is being followed: the figures are of these samples.
  Eigen::Vector2d tip_true_m = Eigen::Vector2d::Zero();
  /// Not a number, like the other measured values, until the first strokes were received.
  Eigen::Vector2d tip_measured_m = Eigen::Vector2d::Constant(std::nan(""));
  double attitude_true_rad = 0.0;
  double attitude_measured_rad = std::nan("");
  Eigen::Vector2d velocity_true_mps = Eigen::Vector2d::Zero();  ///< Of the tip, over the cycle.
  /// Angle between that and what the field wants there; 0 while it hardly moves.
  double off_field_rad = 0.0;
  /// The same of the mean velocity and position of the last kOilPeriod_s: where the tip goes,
  /// without how the oil rings.
  double mean_off_field_rad = 0.0;
  Eigen::Vector2d tip_force_n = Eigen::Vector2d::Zero();
  double fill_m3 = kAbsent;   ///< Of the bucket, loose, where the ground is cut.
  bool regenerating = false;  ///< Any section's check is open.
  Obstruction obstruction = Obstruction::kNone;
  double error_true_m = 0.0;
  double cross_track_true_m = 0.0;  ///< The same with its sign: left of the way is positive.
  double error_measured_m = std::nan("");
  double lambda = 0.0;
  Limit limit;
  std::array<double, kAxisCount> spool_command{};  ///< x / x_m that the duty asks for.
  std::array<double, kAxisCount> spool_real{};
  std::array<double, kAxisCount> velocity_wanted_mps{};  ///< lambda V_L^d
  std::array<double, kAxisCount> velocity_real_mps{};
  std::array<double, kPumpCount> pump_expected_pa{};
  std::array<double, kPumpCount> pump_real_pa{};
  double swash_real = 0.0;  ///< Mean of the machine's pumps, of full swash.
  PumpEnergy energy;
  double cycle_us = 0.0;  ///< Computing time of the controller's cycle.
};

enum class DigEnd { kDone, kPathNotReached, kLoopNotClosed, kFault };

struct DigResult {
  DigEnd end = DigEnd::kDone;
  Fault fault = Fault::kNone;            ///< With kFault.
  std::vector<std::string> faults_left;  ///< Of those that were told, as they were; not reached.
  NodeEmergency emergency;               ///< That stood then.
  std::vector<DigSample> samples;
  double wall_s = 0.0;
  std::uint32_t rejected_frames = 0;
  double peak_chamber_pressure_pa = 0.0;
  double loops = 0.0;       ///< Times round the path.
  double cut_m3 = kAbsent;  ///< Undisturbed soil, where it is cut.
  RealSpoolEdges spool_edges{};
};

/// What of the cross-track error is faster than this rings.
inline constexpr double kRingingAbove_hz = 1.0;

/// Effects of an obstacle.
struct Recovery {
  double lambda_held = 0.0;        ///< Least while it held.
  double off_field_max_rad = 0.0;  ///< Of the tip's true mean direction, afterwards.
  double ringing_max_rad = 0.0;    ///< Of its direction from cycle to cycle, afterwards.
  double error_max_m = 0.0;        ///< Of the true tip, afterwards.
};

/// Figures of the time on the path; absent where it was not reached.
struct DigSummary {
  double max_error_true_m = kAbsent;
  double rmse_error_true_m = kAbsent;
  double max_error_measured_m = kAbsent;
  double rmse_error_measured_m = kAbsent;
  double lambda_min = kAbsent;
  double lambda_mean = kAbsent;
  double lambda_below_1_share = kAbsent;  ///< Of the time on the path.
  double regeneration_share = kAbsent;    ///< Of the time on the path: any check valve open.
  double peak_chamber_pressure_pa = 0.0;
  // Of a ground that is cut, on the way to the path too.
  double cut_m3 = kAbsent;       ///< Undisturbed.
  double fill_max_m3 = kAbsent;  ///< Loose, in the bucket.
  /// With something in the way; from 0.3 s after it let go, for 3 s.
  std::optional<Recovery> recovery;
  double approach_s = kAbsent;     ///< Until the path was reached.
  double loop_s = kAbsent;         ///< On the path; of a run that closed it.
  ExcavatorCalm calm;              ///< The tip works.
  double ringing_rms_m = kAbsent;  ///< Of the true tip's cross-track error above kRingingAbove_hz.
  double energy_per_loop_j = kAbsent;
  RunPace pace;
  LimitShares limit_share;  ///< See logged_limit_shares(); empty without a log.
};

/// Runs until the path was followed `loops` times, something fails, or the time is over. The same
/// machine and options give the same samples (but cycle_us) and the same bytes in the log.
[[nodiscard]] DigResult run_dig(const machines::SimulatedExcavator& machine,
                                const DigOptions& options, const Progress& progress);

[[nodiscard]] DigSummary summarise(const DigResult& result);
[[nodiscard]] const FigureTable<DigSummary>& dig_figures();
[[nodiscard]] inline RunFigures figures_of(const DigSummary& summary) {
  return figures_of(dig_figures(), summary, "share of time active per limit of lambda");
}

}  // namespace graben::runs
