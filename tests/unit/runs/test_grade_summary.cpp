// SPDX-License-Identifier: Apache-2.0
/// Figures of a grading run, from samples made by hand.

#include <cmath>
#include <vector>

#include "app/runs/grade_run.hpp"
#include "tests/unit/cmocka_cpp.hpp"

using runs::GradeResult;
using runs::GradeSample;
using runs::GradeSummary;

const machines::SimulatedDozer& machine() {
  static const machines::SimulatedDozer loaded =
      machines::load_simulated_dozer(machines::find_profile("dozer_9t"));
  return loaded;
}

/// A cycle of 10 ms at 1 m/s over the grade, from x = 0 on; flow at half of what there is.
GradeSample sample(int cycle) {
  GradeSample made;
  made.time_s = 5.0 + 0.01 * cycle;
  made.over_grade = true;
  made.edge_m = {0.01 * cycle, 0.0};
  made.error_measured_m = 0.0;
  made.speed_wanted_mps = 1.0;
  made.speed_true_mps = 1.0;
  made.flow_required_m3ps = 0.5e-3;
  made.flow_available_m3ps = 1e-3;
  return made;
}

GradeResult steady(int cycles) {
  GradeResult result;
  for (int i = 0; i < cycles; ++i) {
    result.samples.push_back(sample(i));
  }
  return result;
}

GradeSummary summary_of(const GradeResult& result) { return runs::summarise(machine(), result); }

TEST(a_run_that_never_came_to_the_grade_has_no_figures) {
  GradeResult result = steady(5);
  for (GradeSample& one : result.samples) {
    one.over_grade = false;
    one.error_true_m = 1.0;
    one.flow_required_m3ps = 1.0;
  }
  const GradeSummary summary = summary_of(result);
  assert_near(summary.max_error_true_m + summary.time_s + summary.flow_share_max, 0.0, 0.0);
  assert_int_equal(summary.flow_occasions, 0);
  assert_int_equal(summary.pace.cycles, 5);
  assert_int_equal(summary_of({}).pace.cycles, 0);
}

TEST(errors_count_below_as_above) {
  GradeResult result = steady(4);
  result.samples[1].error_true_m = 0.003;
  result.samples[2].error_true_m = -0.004;
  result.samples[3].error_measured_m = -0.006;
  const GradeSummary summary = summary_of(result);
  assert_near(summary.max_error_true_m, 0.004, 0.0);
  assert_near(summary.rmse_error_true_m, 0.0025, 1e-12);
  assert_near(summary.max_error_measured_m, 0.006, 0.0);
  assert_near(summary.rmse_error_measured_m, 0.003, 1e-12);
}

/// The time is the edge's over the grade: what comes before and after is not in it.
TEST(time_is_that_over_the_grade) {
  GradeResult result = steady(101);
  GradeSample before = sample(-100);
  before.over_grade = false;
  before.error_true_m = 1.0;
  result.samples.insert(result.samples.begin(), before);
  const GradeSummary summary = summary_of(result);
  assert_near(summary.time_s, 1.0, 1e-9);
  assert_near(summary.mean_speed_mps, 1.0, 1e-9);
  assert_near(summary.max_error_true_m, 0.0, 0.0);
  assert_near(summary.pace.duration_s, 6.0, 1e-9);
  assert_int_equal(summary.corners, 8);
}

/// 2 % over is kept; what follows within half a metre is the same occasion.
TEST(flow_above_the_limit_is_counted_by_occasion) {
  GradeResult result = steady(300);
  result.samples[10].flow_required_m3ps = 1.02e-3;
  assert_int_equal(summary_of(result).flow_occasions, 0);
  for (const std::size_t above : {20U, 21U, 60U, 150U, 199U, 250U}) {
    result.samples[above].flow_required_m3ps = 1.5e-3;
  }
  result.samples[150].flow_required_m3ps = 2e-3;
  const GradeSummary summary = summary_of(result);
  assert_int_equal(summary.flow_occasions, 3);  // 20 .. 60, 150 .. 199, 250
  assert_near(summary.flow_share_max, 2.0, 1e-12);
  assert_near(summary.flow_above_share, 6.0 / 300.0, 1e-12);
}

TEST(the_controllers_own_flow_beside_it) {
  GradeResult result = steady(3);
  result.samples[1].flow_reported_m3ps = 0.9e-3;
  result.samples[1].flow_limit_reported_m3ps = 1.2e-3;
  assert_near(summary_of(result).flow_share_reported_max, 0.75, 1e-12);
}

/// Wanted: from cycle to cycle. True: over 0.1 s, or the body's ringing would be all there is.
TEST(decelerations) {
  GradeResult result = steady(60);
  for (int i = 30; i < 60; ++i) {
    GradeSample& one = result.samples[static_cast<std::size_t>(i)];
    one.speed_wanted_mps = i < 31 ? 0.98 : 0.9;
    one.speed_true_mps = 0.9;
  }
  result.samples[50].speed_true_mps = 0.95;
  const GradeSummary summary = summary_of(result);
  assert_near(summary.deceleration_wanted_mps2, 8.0, 1e-9);
  assert_near(summary.deceleration_true_mps2, 1.0, 1e-9);
}

/// Up, down, up: two turns; ways of less than 0.02 m/s are none.
TEST(turns_of_the_wanted_speed) {
  GradeResult result = steady(400);
  for (int i = 0; i < 400; ++i) {
    const double triangle = std::abs((i % 200) - 100) / 100.0;
    const double ripple = i % 2 == 0 ? 0.009 : -0.009;
    result.samples[static_cast<std::size_t>(i)].speed_wanted_mps = 1.0 + 0.5 * triangle + ripple;
  }
  assert_int_equal(summary_of(result).sign_changes, 3);
  for (GradeSample& one : result.samples) {
    one.speed_wanted_mps = one.speed_wanted_mps > 1.2 ? 1.0 : 1.019;
  }
  assert_int_equal(summary_of(result).sign_changes, 0);
}

/// Before the grade, and between its two stretches, blade and speed jump.
TEST(calm_is_of_the_time_over_the_grade) {
  GradeResult result = steady(402);
  for (int i = 0; i < 402; ++i) {
    GradeSample& one = result.samples[static_cast<std::size_t>(i)];
    const double t = 0.01 * i;
    one.over_grade = i != 0 && i != 201;
    one.lambda = i % 2 == 0 ? 0.5 : 0.6;
    one.spool_real = i % 100 < 50 ? 0.5 : -0.5;
    one.edge_m = {t, t * t * t / 3.0};
    if (!one.over_grade) {
      one.lambda = 0.0;
      one.spool_real = -1.0;
      one.edge_m = {-3.0, 1.0};
    }
  }
  const GradeSummary summary = summary_of(result);
  assert_near(summary.lambda_variation_ps, 10.0, 1e-9);
  assert_near(summary.spool_reversals_ps, 8.0 / 3.98, 1e-9);
  assert_near(summary.spool_travel_ps, 8.0 / 3.98, 1e-9);
  assert_near(summary.edge_jerk_rms_mps3, 2.0, 1e-5);
}

/// A job in passes is headed by what it leaves; one pass by its edge, as before.
TEST(what_is_left_heads_a_job_in_passes) {
  GradeSummary summary;
  summary.max_error_true_m = 1.106;
  summary.ground_left_m = 0.039;
  summary.over_cut_m = 0.049;
  assert_string_equal(headed_figures(summary).values.front().info->name, "max_error_true_m");
  summary.passes = 4;
  const runs::RunFigures figures = headed_figures(summary);
  assert_string_equal(figures.values[0].info->name, "ground_left_m");
  assert_string_equal(figures.values[1].info->name, "over_cut_m");
  assert_string_equal(figures.values[2].info->name, "passes");
  assert_string_equal(figures.values[3].info->name, "max_error_true_m");
  assert_int_equal(figures.values.size(), runs::grade_figures().size());
  // A campaign's columns stand in the table's order.
  assert_string_equal(figures_of(summary).values[0].info->name, "max_error_true_m");
}

TEST(a_grade_out_of_tolerance_is_said) {
  GradeSummary summary;
  summary.ground_left_m = 0.02;
  summary.over_cut_m = 0.02;
  assert_string_equal(runs::out_of_tolerance(summary, 0.02).c_str(), "");
  summary.ground_left_m = 0.039;
  assert_string_equal(runs::out_of_tolerance(summary, 0.02).c_str(),
                      "the grade is out of tolerance: up to 39 mm left above the design and 20 mm "
                      "cut below it; grade.tolerance is 20 mm");
  summary.ground_left_m = 0.0;
  summary.over_cut_m = 0.049;
  assert_non_null(strstr(runs::out_of_tolerance(summary, 0.02).c_str(), "49 mm cut below"));
}
