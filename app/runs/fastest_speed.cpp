// SPDX-License-Identifier: Apache-2.0
#include "app/runs/fastest_speed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace graben::runs {
namespace {

/// Speeds are counted in these.
long steps(double speed_mps) { return std::lround(speed_mps / kFineTrial_mps); }

class Search {
 public:
  Search(const machines::SimulatedDozer& machine, double most_m, const Progress& progress)
      : machine_(machine),
        most_m_(most_m),
        progress_(progress),
        // Down: the operator's speed is the most there is.
        fastest_(static_cast<long>(
            std::floor(machine.profile.travel.speed_desired_mps / kFineTrial_mps + 1e-9))) {}

  FastestSpeed run() {
    const long slowest = steps(kSlowestTrial_mps);
    const long coarse = steps(kCoarseTrial_mps);
    long speed = fastest_;
    while (!is_within(speed) && speed > slowest) {
      speed = std::max(speed - coarse, slowest);
    }
    if (result_.trials.back().within(most_m_)) {
      const long from = std::min(speed + coarse - 1, fastest_ - 1);
      for (long finer = from; finer > speed && !is_within(finer); --finer) {
      }
      result_.found = result_.trials.back().within(most_m_) ? result_.trials.back() : at(speed);
    }
    std::sort(result_.trials.begin(), result_.trials.end(),
              [](const SpeedTrial& a, const SpeedTrial& b) { return a.speed_mps < b.speed_mps; });
    return std::move(result_);
  }

 private:
  bool is_within(long speed) {
    SpeedTrial trial;
    trial.speed_mps = static_cast<double>(speed) * kFineTrial_mps;
    machines::SimulatedDozer machine = machine_;
    machine.profile.travel.speed_desired_mps = trial.speed_mps;
    machine.profile.travel.speed_min_mps =
        std::min(machine.profile.travel.speed_min_mps, trial.speed_mps);
    const GradeResult result = run_grade(machine, {}, [&](double share, const std::string&) {
      progress_(share, fmt::format("{:.2f} m/s", trial.speed_mps));
    });
    trial.end = result.end;
    trial.summary = summarise(machine, result);
    result_.trials.push_back(trial);
    return trial.within(most_m_);
  }

  [[nodiscard]] SpeedTrial at(long speed) const {
    return *std::find_if(result_.trials.begin(), result_.trials.end(),
                         [&](const SpeedTrial& trial) { return steps(trial.speed_mps) == speed; });
  }

  const machines::SimulatedDozer& machine_;
  double most_m_;
  const Progress& progress_;
  long fastest_;
  FastestSpeed result_;
};

}  // namespace

FastestSpeed find_fastest(const machines::SimulatedDozer& machine, double most_m,
                          const Progress& progress) {
  return Search(machine, most_m, progress).run();
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
