// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/machines/task_text.hpp"
#include "app/runs/cut_force_figures.hpp"
#include "app/runs/load_figures.hpp"
#include "firmware/excavator/motion/program/task_run.hpp"

namespace graben::runs {
namespace {

constexpr double kSecondsPerHour = 3600.0;

bool in_step(const AutodigSample& sample) {
  return sample.progress.runs && sample.progress.kind != StepKind::kApproach &&
         sample.progress.kind != StepKind::kDone;
}

/// Step by step, from the samples in their order.
class Steps {
 public:
  explicit Steps(const TaskProgram& program) : program_(program) {}

  void add(const AutodigSample& sample) {
    if (sample.progress.runs) {
      count(sample.progress.missed);
    }
    const int step = sample.progress.step;
    const bool begins = steps_.empty() || steps_.back().step != step;
    if (!steps_.empty() && sample.progress.runs &&
        (begins || sample.progress.kind == StepKind::kDone)) {
      end_last(sample.progress.last_end);
    }
    if (!in_step(sample)) {
      return;
    }
    if (begins) {
      begin(sample);
    }
    StepFigures& figures = steps_.back();
    figures.until_s = sample.time_s;
    if (figures.straight) {
      figures.max_error_true_m = std::max(figures.max_error_true_m, sample.error_true_m);
      figures.max_error_measured_m =
          std::max(figures.max_error_measured_m, sample.error_measured_m);
    }
    // As far as it has come: the last sample of a step is the one that counts.
    figures.end_error_true_m = sample.end_off_true_m;
    figures.end_error_measured_m = sample.end_off_measured_m;
  }

  /// `missed` of the run's end.
  [[nodiscard]] std::vector<StepFigures> take(int missed) {
    count(missed);
    return std::move(steps_);
  }

 private:
  /// A step is counted in the cycle after its last one.
  void count(int missed) {
    if (missed > missed_ && !steps_.empty()) {
      steps_.back().arrived = false;
    }
    missed_ = missed;
  }

  void end_last(UntilKind by) {
    StepFigures& last = steps_.back();
    last.ended_by = by;
    if (by != UntilKind::kEnd) {
      last.end_error_true_m = last.end_error_measured_m = kAbsent;
    }
  }

  void begin(const AutodigSample& sample) {
    const int step = sample.progress.step;
    const TaskStep& planned = program_.step[static_cast<unsigned>(step)];
    const bool again = !steps_.empty() && step < steps_.back().step;
    round_ += again ? 1 : 0;
    StepFigures figures;
    figures.step = step;
    figures.round = round_;
    figures.kind = planned.kind;
    figures.straight = planned.straight && !in_layers(program_) && !sample.progress.off_plan;
    figures.from_s = sample.time_s;
    figures.planned_s = planned.duration_s();
    steps_.push_back(figures);
  }

  const TaskProgram& program_;
  int missed_ = 0;
  int round_ = 0;
  std::vector<StepFigures> steps_;
};

/// How often the task was gone through.
double rounds(const TaskProgram& program, const AutodigResult& result,
              const std::vector<StepFigures>& steps) {
  if (steps.empty()) {
    return 0.0;
  }
  const StepFigures& last = steps.back();
  return result.end == AutodigEnd::kDone
             ? last.round + 1.0
             : last.round + static_cast<double>(last.step) / program.step_count;
}

/// Errors, lambda and times.
FigureTable<AutodigSummary> task_figures() {
  using S = AutodigSummary;
  return {
      {{"max_error_true_m", "true teeth from the lines, max", kMillimetres, "max_error_true_m"},
       [](const S& s) { return s.max_error_true_m; }},
      {{"rmse_error_true_m", "true teeth from the lines, RMSE", kMillimetres, "rmse_error_true_m"},
       [](const S& s) { return s.rmse_error_true_m; }},
      {{"max_error_measured_m", "measured teeth from the lines, max", kMillimetres,
        "max_error_measured_m"},
       [](const S& s) { return s.max_error_measured_m; }},
      {{"rmse_error_measured_m", "measured teeth from the lines, RMSE", kMillimetres},
       [](const S& s) { return s.rmse_error_measured_m; }},
      {{"end_error_true_m", "true teeth from a line's end, max", kMillimetres, "end_error_true_m"},
       [](const S& s) { return s.end_error_true_m; }},
      {{"move_end_error_true_m", "true teeth from a move's end, max", kMillimetres,
        "move_end_error_true_m"},
       [](const S& s) { return s.move_end_error_true_m; }},
      {{"steps_not_arrived", "steps that went on without arriving", kCount, "steps_not_arrived"},
       [](const S& s) { return static_cast<double>(s.not_arrived); }},
      {{"raised_max_m", "digs raised by the design, max", kMillimetres},
       [](const S& s) { return s.raised_max_m; }},
      {{"fence_left_m", "distance to the nearest fence, min", kMillimetres, "fence_left_m",
        BadEnd::kLow},
       [](const S& s) { return s.fence_left_m; }},
      {{"over_cut_max_m", "true edge under the design, max", kMillimetres, "over_cut_max_m"},
       [](const S& s) { return s.over_cut_max_m; }},
      {{"cut_m3", "soil that was cut", kCubicMetres, "cut_m3", BadEnd::kLow},
       [](const S& s) { return s.cut_m3; }},
      {{"cut_m3ph", "soil that was cut in an hour of steps", kCubicMetres, "cut_m3ph",
        BadEnd::kLow},
       [](const S& s) { return s.cut_m3ph; }},
      {{"fill_max_m3", "loose soil in the bucket, max", kCubicMetres, "fill_max_m3", BadEnd::kLow},
       [](const S& s) { return s.fill_max_m3; }},
      {{"full_rounds_ratio", "rounds with a bucket that is 90 % full", kPercent,
        "full_rounds_ratio", BadEnd::kLow},
       [](const S& s) { return s.full_rounds_ratio; }},
      {{"built_within_ratio", "area within 30 mm of its design", kPercent, "built_within_ratio",
        BadEnd::kLow},
       [](const S& s) { return s.built.within_ratio; }},
      {{"built_high_m", "95 % of the area no higher over it than", kMillimetres, "built_high_m"},
       [](const S& s) { return s.built.high_m; }},
      {{"built_low_m", "95 % of it no lower than", kMillimetres, "built_low_m", BadEnd::kLow},
       [](const S& s) { return s.built.low_m; }},
      {{"built_median_m", "half of it no higher over it than", kMillimetres},
       [](const S& s) { return s.built.median_m; }},
      {{"built_left_m3", "left over the design", kCubicMetres, "built_left_m3"},
       [](const S& s) { return s.built.left_m3; }},
      {{"built_over_cut_m3", "cut under the design", kCubicMetres, "built_over_cut_m3"},
       [](const S& s) { return s.built.over_cut_m3; }},
      {{"energy_per_m3_j", "energy for a cubic metre", kKilowattHours, "energy_per_m3_j"},
       [](const S& s) { return s.energy_per_m3_j; }},
      {{"tip_force_within_ratio", "tip force told within a tenth of the largest", kPercent,
        "tip_force_within_ratio", BadEnd::kLow},
       [](const S& s) { return s.tip_force_within_ratio; }},
      {{"tip_force_error_n", "tip force told from the true one, RMS", kNewtons,
        "tip_force_error_n"},
       [](const S& s) { return s.tip_force_error_n; }},
      {{"tip_force_spread", "the same over the deviation told", kRatio},
       [](const S& s) { return s.tip_force_spread; }},
      {{"cut_force_over_n", "force on a cut's teeth over its plan's, RMS", kNewtons,
        "cut_force_over_n"},
       [](const S& s) { return s.cut_force_over_n; }},
      {{"cut_force_over_max_n", "force on a cut's teeth over its plan's, max", kNewtons,
        "cut_force_over_max_n"},
       [](const S& s) { return s.cut_force_over_max_n; }},
      {{"payload_error_ratio", "payload told, error of the capacity, max", kPercent,
        "payload_error_ratio"},
       [](const S& s) { return s.payload_error_ratio; }},
      {{"payload_within_ratio", "payload told within 2 % of the capacity, of lifts", kPercent,
        "payload_within_ratio", BadEnd::kLow},
       [](const S& s) { return s.payload_within_ratio; }},
      {{"payload_spread", "the same over the deviation told, RMS", kRatio},
       [](const S& s) { return s.payload_spread; }},
      {{"lambda_min", "lambda, min", kRatio, nullptr, BadEnd::kLow},
       [](const S& s) { return s.lambda_min; }},
      {{"lambda_mean", "lambda, mean", kRatio, "lambda_mean", BadEnd::kLow},
       [](const S& s) { return s.lambda_mean; }},
      {{"task_s", "time of the steps", kSeconds, "task_s"}, [](const S& s) { return s.task_s; }},
      {{"planned_s", "time of the steps, planned", kSeconds},
       [](const S& s) { return s.planned_s; }},
  };
}

}  // namespace

AutodigSummary summarise(const TaskProgram& program, const AutodigResult& result) {
  AutodigSummary summary;
  Spread error_true;
  Spread error_measured;
  Steps steps(program);
  ExcavatorCalmCount calm(result.spool_edges);
  LoadFigures load(result.capacity_kg);
  CutForceFigures cut_force(program);
  double lambda_sum = 0.0;
  long in_steps = 0;
  summary.lambda_min = 1.0;
  summary.fence_left_m = AutodigSample::kUnknown;
  for (const AutodigSample& sample : result.samples) {
    summary.fence_left_m = std::fmin(summary.fence_left_m, sample.fence_left_m);
    summary.over_cut_max_m = std::fmax(summary.over_cut_max_m, sample.over_cut_m);
    summary.fill_max_m3 = std::fmax(summary.fill_max_m3, sample.fill_m3);
    summary.cut_m3 = std::fmax(summary.cut_m3, sample.cut_m3);
    steps.add(sample);
    load.add(sample);
    cut_force.add(sample);
    if (!in_step(sample)) {
      calm.pause();
      continue;
    }
    calm.add(sample, Eigen::Vector3d(sample.teeth_m.data()));
    ++in_steps;
    lambda_sum += sample.lambda;
    summary.lambda_min = std::min(summary.lambda_min, sample.lambda);
    if (std::isfinite(sample.error_true_m)) {
      error_true.add(sample.error_true_m);
      error_measured.add(sample.error_measured_m);
    }
  }
  load.tell(summary);
  cut_force.tell(summary);
  // What is dug in layers has no lines of its own.
  const bool has_lines = !in_layers(program);
  summary.max_error_true_m = has_lines ? error_true.max() : kAbsent;
  summary.rmse_error_true_m = has_lines ? error_true.rms() : kAbsent;
  summary.max_error_measured_m = has_lines ? error_measured.max() : kAbsent;
  summary.rmse_error_measured_m = has_lines ? error_measured.rms() : kAbsent;
  summary.end_error_true_m = has_lines ? 0.0 : kAbsent;
  summary.steps = steps.take(result.missed);
  summary.not_arrived = result.missed;
  for (const StepFigures& step : summary.steps) {
    summary.planned_s += step.planned_s;
    double& largest_m = step.straight ? summary.end_error_true_m : summary.move_end_error_true_m;
    largest_m = std::fmax(largest_m, step.end_error_true_m);
  }
  if (in_steps > 0) {
    summary.lambda_mean = lambda_sum / static_cast<double>(in_steps);
    summary.task_s = summary.steps.back().until_s - summary.steps.front().from_s;
    summary.cut_m3ph = summary.cut_m3 * kSecondsPerHour / summary.task_s;
  } else {
    summary.lambda_min = 0.0;
  }
  summary.calm = calm.figures();
  summary.energy_per_round_j = summary.calm.energy_per_j(rounds(program, result, summary.steps));
  summary.built = result.built;
  summary.energy_per_m3_j = summary.calm.energy_per_j(summary.cut_m3);
  summary.pace = pace_of(result.samples, result.wall_s);
  return summary;
}

const FigureTable<AutodigSummary>& autodig_figures() {
  using S = AutodigSummary;
  static const FigureTable<S> all = with_pace(with_energy(joined<S>(
      with_calm(task_figures()),
      {
          {{"spool_travel_ps.swing", "swing's spool, full travels a second", kPerSecond},
           [](const S& s) { return s.calm.spool_travel_ps[kSwing]; }},
          {{"spool_reversals_ps.swing", "swing's spool, changes of side a second", kPerSecond},
           [](const S& s) { return s.calm.spool_reversals_ps[kSwing]; }},
          {{"teeth_jerk_rms_mps3", "jerk of the true teeth below 10 Hz, RMS", kMetresPerSecond3},
           [](const S& s) { return s.calm.jerk_rms_mps3; }},
          {{"energy_per_round_j", "energy for one round", kKilowattHours},
           [](const S& s) { return s.energy_per_round_j; }},
      })));
  return all;
}

RunFigures headed_figures(const AutodigSummary& summary) {
  RunFigures figures = figures_of(summary);
  if (std::isfinite(summary.built.within_ratio)) {
    lead_with({"built_within_ratio", "built_high_m", "built_low_m", "built_left_m3",
               "built_over_cut_m3", "over_cut_max_m"},
              figures);
  }
  return figures;
}

namespace {

std::string end_words(const StepFigures& step) {
  return step.ended_by != UntilKind::kEnd
             ? fmt::format("  ended by {}", machines::until_name(step.ended_by))
         : step.arrived ? ""
                        : "  not arrived";
}

}  // namespace

std::string steps_text(const AutodigSummary& summary) {
  const auto millimetres = [](double error_m) {
    return std::isfinite(error_m) ? fmt::format("{:.1f}", error_m * kMillimetres.per_si) : "-";
  };
  std::string text = "step        from s  until s  planned s  from line, max mm  from end mm\n";
  std::string notes;
  for (const StepFigures& step : summary.steps) {
    text += fmt::format("{:<10}{:>8.2f} {:>8.2f} {:>10.2f} {:>18} {:>12}{}\n",
                        machines::step_name(step.kind), step.from_s, step.until_s, step.planned_s,
                        millimetres(step.straight ? step.max_error_true_m : kAbsent),
                        millimetres(step.end_error_true_m), end_words(step));
    if (!step.arrived) {
      notes += fmt::format(
          "step {} ({}) of round {} had not arrived: its end was still {} mm away, as measured, "
          "after {:.0f} s; the next step began from there\n",
          step.step, machines::step_name(step.kind), step.round + 1,
          millimetres(step.end_error_measured_m), kArriveMost_s);
    }
  }
  return text + notes;
}

}  // namespace graben::runs
