// SPDX-License-Identifier: Apache-2.0
/// Calm and energy of digging and of a task, from samples made by hand.

#include <cmath>
#include <cstring>
#include <string>
#include <utility>

#include "app/runs/autodig_run.hpp"
#include "app/runs/dig_run.hpp"
#include "app/runs/path_progress.hpp"
#include "firmware/numeric/constants.hpp"
#include "tests/unit/cmocka_cpp.hpp"

using namespace graben::runs;

/// 10 s on the path after 1 s of approach that shakes, wastes and must not count.
DigResult made() {
  DigResult result;
  result.spool_edges.fill({0.1, 0.1});
  result.loops = 0.5;
  for (int n = 0; n < 1101; ++n) {
    DigSample sample;
    sample.time_s = 0.01 * n;
    sample.on_path = n >= 100;
    const bool odd = n % 2 == 1;
    sample.lambda = sample.on_path ? 0.5 : (odd ? 0.2 : 0.8);
    sample.energy = {1000.0 * n, sample.on_path ? 100.0 * n : 900.0 * n};
    sample.swash_real = sample.on_path ? 0.6 : 0.1;
    sample.spool_real = {odd && !sample.on_path ? -0.5 : 0.5, 0.05, 0.0};
    if (sample.on_path) {
      const double t = sample.time_s - 1.0;
      sample.cross_track_true_m = 0.01 * std::sin(kTwoPi * 5.0 * t) + 0.03;
      sample.spool_real[kBucket] = n % 100 < 50 ? 0.4 : -0.4;
      sample.tip_true_m = {0.5 * t * t * t, 1.0};
    }
    result.samples.push_back(sample);
  }
  return result;
}

double figure(const RunFigures& figures, const std::string& name) {
  for (const FigureValue& value : figures.values) {
    if (value.info->name == name) {
      return value.value;
    }
  }
  fail_msg("no figure %s", name.c_str());
  return kAbsent;
}

/// A loop that was not closed has no time, and no energy of its own.
TEST(a_stopped_run_has_no_figures_of_a_whole_loop) {
  DigResult result = made();
  assert_true(std::isfinite(summarise(result).loop_s));
  for (const DigEnd end : {DigEnd::kFault, DigEnd::kLoopNotClosed, DigEnd::kPathNotReached}) {
    result.end = end;
    const DigSummary summary = summarise(result);
    assert_true(std::isnan(summary.loop_s));
    assert_true(std::isnan(summary.energy_per_loop_j));
    assert_true(std::isfinite(summary.max_error_true_m));
  }
}

TEST(figures_are_of_the_time_on_the_path) {
  const RunFigures figures = figures_of(summarise(made()));
  assert_near(figure(figures, "lambda_variation_ps"), 0.0, 0.0);
  assert_near(figure(figures, "spool_travel_ps.boom"), 0.0, 0.0);
  assert_near(figure(figures, "spool_reversals_ps.boom"), 0.0, 0.0);
  assert_near(figure(figures, "spool_reversals_ps.arm"), 0.0, 0.0);
  // Every half second, for the 20th time in the last cycle.
  assert_near(figure(figures, "spool_reversals_ps.bucket"), 2.0, 1e-9);
  assert_near(figure(figures, "spool_travel_ps.bucket"), 1.6, 1e-9);
  assert_near(figure(figures, "tip_jerk_rms_mps3"), 3.0, 1e-5);
  assert_near(figure(figures, "ringing_rms_m"), 0.01 / std::sqrt(2.0), 1e-4);
  assert_near(figure(figures, "energy_j"), 1e6, 1e-3);
  assert_near(figure(figures, "energy_per_loop_j"), 2e6, 1e-3);
  assert_near(figure(figures, "energy_bypass_relief_share"), 0.1, 1e-9);
  assert_near(figure(figures, "swash_mean"), 0.6, 1e-9);
}

TEST(a_run_that_never_came_to_its_path_has_no_figures_of_it) {
  DigResult result = made();
  for (DigSample& sample : result.samples) {
    sample.on_path = false;
  }
  result.loops = 0.0;
  const RunFigures figures = figures_of(summarise(result));
  for (const char* name : {"energy_per_loop_j", "energy_bypass_relief_share", "max_error_true_m",
                           "rmse_error_measured_m", "lambda_min", "lambda_mean", "loop_s",
                           "approach_s", "ringing_rms_m"}) {
    assert_true(std::isnan(figure(figures, name)));
  }
  for (const char* name : {"lambda_variation_ps", "spool_travel_ps.boom", "tip_jerk_rms_mps3",
                           "energy_j", "swash_mean"}) {
    assert_near(figure(figures, name), 0.0, 0.0);
  }
}

/// On the way to the path too; without such ground there is no figure.
TEST(what_was_cut_is_told) {
  DigResult result = made();
  assert_true(std::isnan(figure(figures_of(summarise(result)), "cut_m3")));
  assert_true(std::isnan(figure(figures_of(summarise(result)), "fill_max_m3")));
  result.cut_m3 = 2.5;
  result.samples[50].fill_m3 = 0.8;
  result.samples[500].fill_m3 = 0.6;
  assert_near(figure(figures_of(summarise(result)), "cut_m3"), 2.5, 0.0);
  assert_near(figure(figures_of(summarise(result)), "fill_max_m3"), 0.8, 0.0);
}

/// Two steps, left in the second one of the third round: the energy of 2.5 rounds,
/// without that of the approach between.
TEST(a_tasks_energy_is_of_a_round) {
  TaskProgram program;
  program.step_count = 2;
  AutodigResult result;
  result.end = AutodigEnd::kNotFinished;
  result.spool_edges.fill({0.1, 0.1});
  const auto add = [&](StepKind kind, int step) {
    AutodigSample sample;
    sample.progress.runs = true;
    sample.progress.kind = kind;
    sample.progress.step = static_cast<decltype(sample.progress.step)>(step);
    const auto n = static_cast<double>(result.samples.size());
    sample.energy = {1000.0 * n, 250.0 * n};
    sample.spool_real[kSwing] = step == 0 ? 0.3 : -0.3;
    result.samples.push_back(sample);
  };
  add(StepKind::kApproach, 1);
  for (const int step : {0, 1}) {
    add(StepKind::kSwing, step);
  }
  add(StepKind::kApproach, 1);
  for (const int step : {0, 1, 0, 1}) {
    add(StepKind::kSwing, step);
  }
  RunFigures figures = figures_of(summarise(program, result));
  assert_near(figure(figures, "energy_j"), 4000.0, 1e-9);
  assert_near(figure(figures, "energy_per_round_j"), 4000.0 / 2.5, 1e-9);
  assert_near(figure(figures, "energy_bypass_relief_share"), 0.25, 1e-12);
  assert_near(figure(figures, "spool_reversals_ps.swing"), 100.0, 1e-9);
  assert_near(figure(figures, "spool_travel_ps.swing"), 60.0, 1e-9);
  result.end = AutodigEnd::kDone;
  figures = figures_of(summarise(program, result));
  assert_near(figure(figures, "energy_per_round_j"), 4000.0 / 3.0, 1e-9);
}

/// A step whose end was not reached is told with how far it was from it, measured and true; one
/// that is the run's last as well, since the controller counts it in the cycle after.
TEST(what_has_not_arrived_is_told) {
  TaskProgram program;
  program.step_count = 2;
  program.step[0].kind = StepKind::kDig;
  program.step[1].kind = StepKind::kSwing;
  program.step[1].straight = false;
  AutodigResult result;
  result.spool_edges.fill({0.1, 0.1});
  const auto add = [&](int step, double off_m, std::uint8_t missed) {
    AutodigSample sample;
    sample.progress.runs = true;
    sample.progress.kind = program.step[static_cast<unsigned>(step)].kind;
    sample.progress.step = static_cast<std::uint8_t>(step);
    sample.progress.missed = missed;
    sample.end_off_true_m = off_m;
    sample.end_off_measured_m = 0.5 * off_m;
    result.samples.push_back(sample);
  };
  add(0, 0.100, 0);
  add(0, 0.004, 0);
  add(1, 0.900, 0);
  add(1, 0.020, 0);
  AutodigSummary summary = summarise(program, result);
  assert_true(summary.steps[0].arrived && summary.steps[1].arrived);
  assert_near(summary.end_error_true_m, 0.004, 1e-12);
  assert_near(summary.move_end_error_true_m, 0.020, 1e-12);
  assert_near(figure(figures_of(summary), "steps_not_arrived"), 0.0, 0.0);
  assert_null(std::strstr(steps_text(summary).c_str(), "not arrived"));
  result.missed = 1;
  summary = summarise(program, result);
  assert_true(summary.steps[0].arrived && !summary.steps[1].arrived);
  assert_near(figure(figures_of(summary), "steps_not_arrived"), 1.0, 0.0);
  assert_non_null(std::strstr(
      steps_text(summary).c_str(),
      "step 1 (swing) of round 1 had not arrived: its end was still 10.0 mm away, as measured, "
      "after 10 s"));
  result.samples[2].progress.missed = result.samples[3].progress.missed = 1;
  summary = summarise(program, result);
  assert_true(!summary.steps[0].arrived && summary.steps[1].arrived);
}

/// Teeth are not where the ground is: what was made of an area heads its figures.
TEST(what_is_left_heads_an_area) {
  AutodigSummary summary;
  assert_string_equal(headed_figures(summary).values.front().info->name, "max_error_true_m");
  summary.built.within_ratio = 0.98;
  const RunFigures figures = headed_figures(summary);
  assert_string_equal(figures.values[0].info->name, "built_within_ratio");
  assert_string_equal(figures.values[5].info->name, "over_cut_max_m");
  assert_string_equal(figures.values[6].info->name, "max_error_true_m");
  assert_int_equal(figures.values.size(), autodig_figures().size());
}

/// Seconds until the path counts as reached, along its top at this speed, and the metres counted
/// within the next two.
std::pair<double, double> reached_s(double speed_mps) {
  const RoundedRectangle path(DigPath{3.5, 6.5, -2.2, 0.2, 0.4});
  PathProgress progress(path, 1.0);
  double at_s = -1.0;
  for (int n = 0; n < 20000; ++n) {
    const double time_s = 0.01 * n;
    progress.update({4.0 + speed_mps * time_s, 0.2}, true, static_cast<TimeUs>(n) * 10000);
    at_s = at_s < 0.0 && progress.on_path() ? time_s : at_s;
    if (at_s >= 0.0 && time_s >= at_s + 2.0) {
      return {at_s, progress.share() * path.length_m()};
    }
  }
  return {at_s, 0.0};
}

/// After half a second at full speed; a slow approach's last millimetres are no error of its path.
TEST(a_path_is_reached_after_a_time_and_a_way) {
  const auto [fast_s, fast_m] = reached_s(0.6);
  assert_near(fast_s, 0.5, 0.011);
  assert_near(fast_m, 1.2, 0.01);
  const auto [slow_s, slow_m] = reached_s(0.03);
  assert_near(slow_s, 0.2 / 0.03, 0.02);
  assert_near(slow_m, 0.06, 0.001);
}
