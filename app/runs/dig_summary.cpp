// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "app/runs/dig_run.hpp"

namespace graben::runs {
namespace {

/// The rebound of the oil is over after this; the figures are of the time that follows, so long.
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

/// Errors, lambda, times and what an obstacle did.
FigureTable<DigSummary> path_figures() {
  using S = DigSummary;
  return {
      {{"max_error_true_m", "path error of the true tip, max", kMillimetres, "max_error_true_m"},
       [](const S& s) { return s.max_error_true_m; }},
      {{"rmse_error_true_m", "path error of the true tip, RMSE", kMillimetres, "rmse_error_true_m"},
       [](const S& s) { return s.rmse_error_true_m; }},
      {{"max_error_measured_m", "path error of the measured tip, max", kMillimetres,
        "max_error_measured_m"},
       [](const S& s) { return s.max_error_measured_m; }},
      {{"rmse_error_measured_m", "path error of the measured tip, RMSE", kMillimetres,
        "rmse_error_measured_m"},
       [](const S& s) { return s.rmse_error_measured_m; }},
      {{"lambda_min", "lambda, min", kRatio, "lambda_min", BadEnd::kLow},
       [](const S& s) { return s.lambda_min; }},
      {{"lambda_mean", "lambda, mean", kRatio, "lambda_mean", BadEnd::kLow},
       [](const S& s) { return s.lambda_mean; }},
      {{"lambda_below_1_share", "time with lambda below 1", kPercent, "lambda_below_1"},
       [](const S& s) { return s.lambda_below_1_share; }},
      {{"regeneration_share", "time with a regeneration check open", kPercent, "regeneration"},
       [](const S& s) { return s.regeneration_share; }},
      {{"loop_s", "time round the path", kSeconds, "loop_s"}, [](const S& s) { return s.loop_s; }},
      {{"approach_s", "time to reach the path", kSeconds, "approach_s"},
       [](const S& s) { return s.approach_s; }},
      {{"peak_chamber_pressure_pa", "highest chamber pressure", kMegapascals,
        "peak_chamber_pressure_pa"},
       [](const S& s) { return s.peak_chamber_pressure_pa; }},
      // No columns: a campaign that was begun goes on.
      {{"cut_m3", "soil that was cut", kCubicMetres}, [](const S& s) { return s.cut_m3; }},
      {{"fill_max_m3", "loose soil in the bucket, max", kCubicMetres},
       [](const S& s) { return s.fill_max_m3; }},
      {{"recovery.lambda_held", "lambda while the obstacle holds, min", kRatio, "lambda_held",
        BadEnd::kLow},
       [](const S& s) { return s.recovery ? s.recovery->lambda_held : kAbsent; }},
      {{"recovery.off_field_max_rad", "mean direction off the field afterwards, max", kDegrees,
        "off_field_max_rad"},
       [](const S& s) { return s.recovery ? s.recovery->off_field_max_rad : kAbsent; }},
      {{"recovery.ringing_max_rad", "the same from cycle to cycle", kDegrees, "ringing_max_rad"},
       [](const S& s) { return s.recovery ? s.recovery->ringing_max_rad : kAbsent; }},
      {{"recovery.error_max_m", "path error of the true tip afterwards, max", kMillimetres,
        "recovery_error_max_m"},
       [](const S& s) { return s.recovery ? s.recovery->error_max_m : kAbsent; }},
  };
}

}  // namespace

DigSummary summarise(const DigResult& result) {
  DigSummary summary;
  Spread error_true;
  Spread error_measured;
  ExcavatorCalmCount calm(result.spool_edges);
  std::vector<double> cross_track_m;
  double lambda_sum = 0.0;
  long on_path = 0;
  long below_1 = 0;
  long regenerating = 0;
  double lambda_min = 1.0;
  for (const DigSample& sample : result.samples) {
    summary.fill_max_m3 = std::fmax(summary.fill_max_m3, sample.fill_m3);
    if (!sample.on_path) {
      continue;
    }
    if (on_path++ == 0) {
      summary.approach_s = sample.time_s;
    }
    error_true.add(sample.error_true_m);
    error_measured.add(sample.error_measured_m);
    lambda_min = std::min(lambda_min, sample.lambda);
    lambda_sum += sample.lambda;
    below_1 += sample.lambda < 1.0 ? 1 : 0;
    regenerating += sample.regenerating ? 1 : 0;
    summary.loop_s = sample.time_s - summary.approach_s;
    calm.add(sample, {sample.tip_true_m.x(), 0.0, sample.tip_true_m.y()});
    cross_track_m.push_back(sample.cross_track_true_m);
  }
  const bool is_closed = result.end == DigEnd::kDone;
  if (!is_closed) {
    summary.loop_s = kAbsent;  // Of a loop that was not closed there is no time.
  }
  if (on_path > 0) {
    const auto count = static_cast<double>(on_path);
    summary.max_error_true_m = error_true.max();
    summary.rmse_error_true_m = error_true.rms();
    summary.max_error_measured_m = error_measured.max();
    summary.rmse_error_measured_m = error_measured.rms();
    summary.lambda_min = lambda_min;
    summary.lambda_mean = lambda_sum / count;
    summary.lambda_below_1_share = static_cast<double>(below_1) / count;
    summary.regeneration_share = static_cast<double>(regenerating) / count;
    summary.ringing_rms_m = ringing_rms(cross_track_m, kRingingAbove_hz);
  }
  summary.peak_chamber_pressure_pa = result.peak_chamber_pressure_pa;
  summary.cut_m3 = result.cut_m3;
  summary.recovery = recovery(result.samples);
  summary.calm = calm.figures();
  summary.energy_per_loop_j = is_closed ? summary.calm.energy_per_j(result.loops) : kAbsent;
  summary.pace = pace_of(result.samples, result.wall_s);
  return summary;
}

const FigureTable<DigSummary>& dig_figures() {
  using S = DigSummary;
  static const FigureTable<S> all = with_pace(with_energy(joined<S>(
      with_calm(path_figures()),
      {
          {{"tip_jerk_rms_mps3", "jerk of the true tip below 10 Hz, RMS", kMetresPerSecond3,
            "tip_jerk_rms_mps3"},
           [](const S& s) { return s.calm.jerk_rms_mps3; }},
          {{"ringing_rms_m", "path error of the true tip above 1 Hz, RMS", kMillimetres,
            "ringing_rms_m"},
           [](const S& s) { return s.ringing_rms_m; }},
          {{"energy_per_loop_j", "energy for one loop", kKilowattHours, "energy_per_loop_j"},
           [](const S& s) { return s.energy_per_loop_j; }},
      })));
  return all;
}

}  // namespace graben::runs
