// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A fit that is judged by motion that it has not seen.

#include <vector>

#include "app/identify/machine/estimate.hpp"
#include "app/identify/machine/log_split.hpp"
#include "app/identify/machine/machine_fit.hpp"
#include "app/identify/machine/prediction_score.hpp"
#include "firmware/excavator/excavator_profile.hpp"

namespace graben::identify {

struct JudgedFit {
  MachineEstimate machine;   ///< Of all logs.
  ExcavatorProfile profile;  ///< identified() by it.
  PredictionScore before;    ///< Of the old profile, on what was left out.
  PredictionScore left_out;  ///< Of a profile fitted without what judges, on that.
  PredictionScore after;     ///< Of `profile`, on the same.
  double fitted_s = 0.0;     ///< Motion that the second one was fitted to.
  double judged_s = 0.0;

  /// On what was left out both predict better than the old profile, all axes together, and neither
  /// makes any axis worse by more than kWorse.
  [[nodiscard]] bool is_better() const;
  /// It predicts motion at all: better than a machine that stands.
  [[nodiscard]] bool predicts() const { return left_out.share() < 1.0 && after.share() < 1.0; }
};

/// A share of an axis' measured speed: more of it an axis must not lose for the others' gain.
inline constexpr double kWorse = 0.02;

/// Fits twice: without what judges, to be judged, and to all of the logs, for the values. Throws as
/// split_logs() and identify_machine().
[[nodiscard]] JudgedFit fit_and_judge(const ExcavatorProfile& profile,
                                      const std::vector<MachineLog>& logs,
                                      const MachineProgress& progress);

}  // namespace graben::identify
