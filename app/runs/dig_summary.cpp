#include <algorithm>

#include "app/runs/dig_run.hpp"
#include "app/runs/statistics.hpp"

namespace graben::runs {
namespace {

/// The rebound of the oil is over after this; what comes then is judged for so long.
constexpr double kRebound_s = 0.3;
constexpr double kJudged_s = 3.0;

std::optional<Recovery> recovery(const std::vector<DigSample>& samples) {
  std::optional<Recovery> found;
  double released_s = -1.0;
  for (const DigSample& sample : samples) {
    if (sample.obstruction == Obstruction::kNone) {
      continue;
    }
    if (!found) {
      found = Recovery{1.0, 0.0, 0.0, 0.0};
    }
    if (sample.obstruction == Obstruction::kHolding) {
      found->lambda_held = std::min(found->lambda_held, sample.lambda);
      continue;
    }
    released_s = released_s < 0.0 ? sample.time_s : released_s;
    const double since_s = sample.time_s - released_s;
    if (since_s < kRebound_s || since_s > kRebound_s + kJudged_s) {
      continue;
    }
    found->error_max_m = std::max(found->error_max_m, sample.error_true_m);
    found->ringing_max_rad = std::max(found->ringing_max_rad, sample.off_field_rad);
    if (since_s >= kRebound_s + kOilPeriod_s) {  // A mean that knows nothing of the rebound.
      found->off_field_max_rad = std::max(found->off_field_max_rad, sample.mean_off_field_rad);
    }
  }
  return found;
}

}  // namespace

DigSummary summarise(const DigResult& result) {
  DigSummary summary;
  Spread error_true;
  Spread error_measured;
  LimitCount limits(excavator_actuators());
  std::vector<double> cycle_us;
  double lambda_sum = 0.0;
  long on_path = 0;
  long below_1 = 0;
  long regenerating = 0;
  summary.lambda_min = 1.0;
  for (const DigSample& sample : result.samples) {
    cycle_us.push_back(sample.cycle_us);
    summary.cycle_max_us = std::max(summary.cycle_max_us, sample.cycle_us);
    if (!sample.on_path) {
      continue;
    }
    if (on_path++ == 0) {
      summary.approach_s = sample.time_s;
    }
    error_true.add(sample.error_true_m);
    error_measured.add(sample.error_measured_m);
    summary.lambda_min = std::min(summary.lambda_min, sample.lambda);
    lambda_sum += sample.lambda;
    below_1 += sample.lambda < 1.0 ? 1 : 0;
    regenerating += sample.regenerating ? 1 : 0;
    summary.loop_s = sample.time_s - summary.approach_s;
    limits.add(sample.limit);
  }
  if (on_path == 0) {
    summary.lambda_min = 0.0;
  }
  const auto share = [&](long count) {
    return on_path > 0 ? static_cast<double>(count) / static_cast<double>(on_path) : 0.0;
  };
  summary.max_error_true_m = error_true.max();
  summary.rmse_error_true_m = error_true.rms();
  summary.max_error_measured_m = error_measured.max();
  summary.rmse_error_measured_m = error_measured.rms();
  summary.lambda_mean = on_path > 0 ? lambda_sum / static_cast<double>(on_path) : 0.0;
  summary.lambda_below_1_share = share(below_1);
  summary.regeneration_share = share(regenerating);
  summary.peak_chamber_pressure_pa = result.peak_chamber_pressure_pa;
  summary.recovery = recovery(result.samples);
  summary.cycles = static_cast<long>(result.samples.size());
  summary.duration_s = result.samples.empty() ? 0.0 : result.samples.back().time_s;
  summary.real_time_factor = result.wall_s > 0.0 ? summary.duration_s / result.wall_s : 0.0;
  summary.cycle_median_us = median(cycle_us);
  summary.limit_share = limits.shares();
  return summary;
}

}  // namespace graben::runs
