// SPDX-License-Identifier: Apache-2.0
#include "app/runs/fastest_speed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace graben::runs {
namespace {

/// Speeds are counted in these.
long steps(double speed_mps) { return std::lround(speed_mps / kFineTrial_mps); }

}  // namespace

ConstantSpeeds::ConstantSpeeds(machines::SimulatedDozer machine)
    : machine_(std::move(machine)),
      // Down: the operator's speed is the most there is.
      fastest_(static_cast<long>(
          std::floor(machine_.profile.travel.speed_desired_mps / kFineTrial_mps + 1e-9))) {}

const SpeedTrial& ConstantSpeeds::trial(long speed, const Progress& progress) {
  const auto known = trials_.find(speed);
  if (known != trials_.end()) {
    return known->second;
  }
  SpeedTrial trial;
  trial.speed_mps = static_cast<double>(speed) * kFineTrial_mps;
  machines::SimulatedDozer machine = machine_;
  machine.profile.travel.speed_desired_mps = trial.speed_mps;
  machine.profile.travel.speed_min_mps =
      std::min(machine.profile.travel.speed_min_mps, trial.speed_mps);
  const GradeResult result = run_grade(machine, {}, [&](double share, const std::string&) {
    progress(share, fmt::format("{:.2f} m/s", trial.speed_mps));
  });
  trial.end = result.end;
  trial.summary = summarise(machine, result);
  return trials_.emplace(speed, trial).first->second;
}

std::optional<SpeedTrial> ConstantSpeeds::fastest(double most_m, const Progress& progress) {
  const long slowest = steps(kSlowestTrial_mps);
  const long coarse = steps(kCoarseTrial_mps);
  const auto is_within = [&](long speed) { return trial(speed, progress).within(most_m); };
  long speed = fastest_;
  while (!is_within(speed) && speed > slowest) {
    speed = std::max(speed - coarse, slowest);
  }
  if (!is_within(speed)) {
    return std::nullopt;
  }
  for (long finer = std::min(speed + coarse - 1, fastest_ - 1); finer > speed; --finer) {
    if (is_within(finer)) {
      return trial(finer, progress);
    }
  }
  return trial(speed, progress);
}

FastestSpeed find_fastest(const machines::SimulatedDozer& machine, double most_m,
                          const Progress& progress) {
  ConstantSpeeds speeds(machine);
  FastestSpeed result;
  result.found = speeds.fastest(most_m, progress);
  for (const auto& [speed, trial] : speeds.trials()) {
    result.trials.push_back(trial);
  }
  return result;
}

std::string fastest_table(const FastestSpeed& result, double most_m) {
  std::string table = "  speed    max error     time    flow, max\n";
  for (const SpeedTrial& trial : result.trials) {
    const bool done = trial.end == GradeEnd::kDone;
    table += done ? fmt::format("{:>7.2f}{:>10.1f} mm{:>9.2f} s{:>9.1f} %{}\n", trial.speed_mps,
                                trial.summary.max_error_true_m * 1e3, trial.summary.time_s,
                                trial.summary.flow_share_max * 100.0,
                                trial.within(most_m) ? "" : "  too far off")
                  : fmt::format("{:>7.2f}  did not come to the end\n", trial.speed_mps);
  }
  if (result.found) {
    table += fmt::format("fastest within {:.1f} mm: {:.2f} m/s, {:.2f} s\n", most_m * 1e3,
                         result.found->speed_mps, result.found->summary.time_s);
  }
  return table;
}

}  // namespace graben::runs
