// SPDX-License-Identifier: Apache-2.0
#include "app/identify/machine/judged_fit.hpp"

#include "app/identify/machine/identified_profile.hpp"
#include "app/identify/machine/swing_figures.hpp"

namespace graben::identify {
namespace {

bool is_no_worse(const PredictionScore& now, const PredictionScore& before) {
  for (std::size_t k = 0; k < kAxisCount; ++k) {
    if (now.axis[k].share() > before.axis[k].share() + kWorse) {
      return false;
    }
  }
  return now.share() <= before.share();
}

/// Progress of a part of the work.
MachineProgress part(const MachineProgress& progress, double from, double until) {
  return
      [=](double share, const std::string& what) { progress(from + (until - from) * share, what); };
}

}  // namespace

bool JudgedFit::is_better() const {
  return predicts() && is_no_worse(left_out, before) && is_no_worse(after, before);
}

JudgedFit fit_and_judge(const ExcavatorProfile& profile, const std::vector<MachineLog>& logs,
                        const MachineProgress& progress) {
  JudgedFit fit;
  const LogSplit split = split_logs(logs);
  fit.fitted_s = split.fitted_s;
  fit.judged_s = split.judged_s;
  const DriveModel old(profile);
  const MachineEstimate without = identify_machine(old, split.fitted, part(progress, 0.0, 0.4));
  fit.machine = identify_machine(old, logs, part(progress, 0.4, 0.85));
  fit.machine.swing = find_swing(profile, logs);
  fit.profile = identified(profile, fit.machine);
  progress(0.85, "judges by what was left out");
  const auto judged = [&](const DriveModel& model) {
    return score_of(model, logs, split.judged, fit.machine.drive);
  };
  fit.before = judged(old);
  fit.left_out = judged(DriveModel(identified(profile, without)));
  fit.after = judged(DriveModel(fit.profile));
  progress(1.0, "done");
  return fit;
}

}  // namespace graben::identify
