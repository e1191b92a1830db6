#include <algorithm>
#include <cmath>

#include "app/runs/autodig_run.hpp"
#include "app/runs/statistics.hpp"

namespace graben::runs {
namespace {

bool in_step(const AutodigSample& sample) {
  return sample.progress.runs && sample.progress.kind != StepKind::kApproach &&
         sample.progress.kind != StepKind::kDone;
}

/// Step by step, from the samples in their order.
class Steps {
 public:
  explicit Steps(const TaskProgram& program) : program_(program) {}

  void add(const AutodigSample& sample) {
    if (!in_step(sample)) {
      return;
    }
    const int step = sample.progress.step;
    if (steps_.empty() || steps_.back().step != step) {
      begin(sample);
    }
    StepFigures& figures = steps_.back();
    figures.until_s = sample.time_s;
    if (figures.straight) {
      figures.max_error_true_m = std::max(figures.max_error_true_m, sample.error_true_m);
      figures.max_error_measured_m =
          std::max(figures.max_error_measured_m, sample.error_measured_m);
    }
    last_ = &sample;
    end_of(figures);
  }

  [[nodiscard]] std::vector<StepFigures> take() { return std::move(steps_); }

 private:
  void begin(const AutodigSample& sample) {
    const int step = sample.progress.step;
    const TaskStep& planned = program_.step[static_cast<unsigned>(step)];
    const bool again = !steps_.empty() && step < steps_.back().step;
    round_ += again ? 1 : 0;
    StepFigures figures;
    figures.step = step;
    figures.round = round_;
    figures.kind = planned.kind;
    figures.straight = planned.straight;
    figures.from_s = sample.time_s;
    figures.planned_s = planned.duration_s();
    steps_.push_back(figures);
  }

  /// As far as it has come: the last sample of a step is the one that counts.
  void end_of(StepFigures& figures) const {
    const TaskStep& planned = program_.step[static_cast<unsigned>(figures.step)];
    if (!planned.straight) {
      return;
    }
    const Eigen::Vector3d end_m = planned.line.line.at(1.0).position_m;
    const Eigen::Vector3d teeth_m(last_->teeth_m[0], last_->teeth_m[1], last_->teeth_m[2]);
    figures.end_error_true_m = (teeth_m - end_m).norm();
  }

  const TaskProgram& program_;
  const AutodigSample* last_ = nullptr;
  int round_ = 0;
  std::vector<StepFigures> steps_;
};

}  // namespace

AutodigSummary summarise(const TaskProgram& program, const AutodigResult& result) {
  AutodigSummary summary;
  Spread error_true;
  Spread error_measured;
  LimitCount limits(excavator_actuators());
  Steps steps(program);
  std::vector<double> cycle_us;
  double lambda_sum = 0.0;
  long in_steps = 0;
  summary.lambda_min = 1.0;
  summary.fence_left_m = AutodigSample::kUnknown;
  for (const AutodigSample& sample : result.samples) {
    cycle_us.push_back(sample.cycle_us);
    summary.cycle_max_us = std::max(summary.cycle_max_us, sample.cycle_us);
    summary.fence_left_m = std::fmin(summary.fence_left_m, sample.fence_left_m);
    steps.add(sample);
    if (!in_step(sample)) {
      continue;
    }
    ++in_steps;
    lambda_sum += sample.lambda;
    summary.lambda_min = std::min(summary.lambda_min, sample.lambda);
    limits.add(sample.limit);
    if (std::isfinite(sample.error_true_m)) {
      error_true.add(sample.error_true_m);
      error_measured.add(sample.error_measured_m);
    }
  }
  summary.max_error_true_m = error_true.max();
  summary.rmse_error_true_m = error_true.rms();
  summary.max_error_measured_m = error_measured.max();
  summary.rmse_error_measured_m = error_measured.rms();
  summary.steps = steps.take();
  for (const StepFigures& step : summary.steps) {
    summary.planned_s += step.planned_s;
    summary.end_error_true_m = std::max(summary.end_error_true_m, step.end_error_true_m);
  }
  if (in_steps > 0) {
    summary.lambda_mean = lambda_sum / static_cast<double>(in_steps);
    summary.task_s = summary.steps.back().until_s - summary.steps.front().from_s;
  } else {
    summary.lambda_min = 0.0;
  }
  summary.cycles = static_cast<long>(result.samples.size());
  summary.duration_s = result.samples.empty() ? 0.0 : result.samples.back().time_s;
  summary.real_time_factor = result.wall_s > 0.0 ? summary.duration_s / result.wall_s : 0.0;
  summary.cycle_median_us = median(cycle_us);
  summary.limit_share = limits.shares();
  return summary;
}

}  // namespace graben::runs
