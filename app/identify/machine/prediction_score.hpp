// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How far a prediction is from what was measured, by axis and direction, over the parts in motion.

#include <string>
#include <vector>

#include "app/identify/machine/estimate.hpp"
#include "app/identify/machine/log_split.hpp"
#include "app/identify/machine/prediction.hpp"

namespace graben::identify {

/// Of one drive and direction.
struct SideScore {
  double moving_s = 0.0;  ///< Time that was judged; 0: nothing else is set.
  double rms_mps = 0.0;
  double r2 = 0.0;  ///< 1 less the error's share of the measured speed's variance.
  bool has_ratio = false;
  double speed_ratio = 1.0;  ///< Measured over predicted speed, where both last.
  bool has_delay = false;
  double late_s = 0.0;  ///< So much later than predicted it answers; see judge_spools().
};

struct AxisScore {
  SideScore extend;
  SideScore retract;
  double error_mps2 = 0.0;  ///< Sum of squared errors, and of squared measured speeds.
  double speed_mps2 = 0.0;

  [[nodiscard]] SideScore& side(bool extends) { return extends ? extend : retract; }
  [[nodiscard]] const SideScore& side(bool extends) const { return extends ? extend : retract; }
  /// RMS error as a share of the RMS of the measured speed; 0 where it did not move.
  [[nodiscard]] double share() const;
};

struct PredictionScore {
  std::array<AxisScore, kDriveCount> axis;

  /// Of all axes that moved: root of the mean square of their shares.
  [[nodiscard]] double share() const;
};

/// Judges a prediction of each log, over these stretches.
[[nodiscard]] PredictionScore score(const std::vector<std::vector<PredictedSegment>>& predicted,
                                    const std::vector<LogStretch>& stretches);

/// Times of the spools in these logs, where they are measured; else nothing is known.
[[nodiscard]] DriveEstimates spool_answers(const DriveModel& model,
                                           const std::vector<MachineLog>& logs);

/// How late a side answers, by its spool where that is known: a cylinder that swings on its oil has
/// a delay that is no valve's.
void judge_spools(const DriveModel& model, const DriveEstimates& found, PredictionScore& score);

/// Of a model's prediction of the logs, and of its spools by what was found of them.
[[nodiscard]] PredictionScore score_of(const DriveModel& model, const std::vector<MachineLog>& logs,
                                       const std::vector<LogStretch>& stretches,
                                       const DriveEstimates& spools);

/// From here on a sentence is worth reading.
inline constexpr double kRatioWorth = 0.03;
inline constexpr double kLateWorth_s = 0.020;

/// A sentence for each side whose speed or delay is off by more than these: "the arm, extending, is
/// 8 % slower than the profile says".
[[nodiscard]] std::vector<std::string> score_sentences(const PredictionScore& score);

/// "the arm, extending": sides that have no ratio; of a swing that did not move nothing is said.
[[nodiscard]] std::vector<std::string> unjudged_sides(const PredictionScore& score);

/// Some side has a ratio.
[[nodiscard]] bool any_judged(const PredictionScore& score);

/// Largest difference of a speed from its prediction, as a share of it; of sides that have a ratio.
[[nodiscard]] double most_off(const PredictionScore& score);

inline constexpr std::array<const char*, kDriveCount> kAxisTexts = {"boom", "arm", "bucket",
                                                                    "swing"};

}  // namespace graben::identify
