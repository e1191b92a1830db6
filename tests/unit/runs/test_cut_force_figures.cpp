// SPDX-License-Identifier: Apache-2.0
/// Force on a cut's teeth over its plan's, from samples made by hand.

#include "app/runs/cut_force_figures.hpp"

#include <cmath>

#include "tests/unit/cmocka_cpp.hpp"

using namespace graben;
using namespace graben::runs;

namespace {

constexpr double kAllowed_n = 1000.0;

/// Digs inwards, falling by `falls_m` on 4 m of level way.
TaskProgram in_layers_falling(double falls_m) {
  TaskProgram program;
  program.layers.step = 0;
  program.layers.force_n = kAllowed_n;
  program.step[0].line.line.change.position_m = Eigen::Vector3d(-4.0, 0.0, -falls_m);
  program.step_count = 1;
  return program;
}

AutodigSample sample_of(StepKind kind, double share, double outwards_n, double up_n) {
  AutodigSample sample;
  sample.progress.runs = true;
  sample.progress.kind = kind;
  sample.progress_share = share;
  sample.tip_force_n = {outwards_n, up_n};
  return sample;
}

AutodigSummary told(const CutForceFigures& figures) {
  AutodigSummary summary;
  figures.tell(summary);
  return summary;
}

}  // namespace

TEST(counts_what_is_over_the_plan_and_the_time_without) {
  CutForceFigures figures(in_layers_falling(0.0));
  figures.add(sample_of(StepKind::kDig, 0.1, 1300.0, 0.0));
  figures.add(sample_of(StepKind::kDig, 0.2, 1400.0, -5000.0));
  figures.add(sample_of(StepKind::kDig, 0.3, 900.0, 0.0));
  figures.add(sample_of(StepKind::kDig, 0.4, -9000.0, 0.0));
  const AutodigSummary summary = told(figures);
  assert_near(summary.cut_force_over_n, 250.0, 1e-9);
  assert_near(summary.cut_force_over_max_n, 400.0, 1e-9);
}

/// By the line's direction: soil that is pushed down by a cut that falls by 3 on 4 counts by 0.6.
TEST(counts_along_the_line) {
  CutForceFigures figures(in_layers_falling(3.0));
  figures.add(sample_of(StepKind::kDig, 0.5, 1000.0, 1000.0));
  const AutodigSummary summary = told(figures);
  assert_near(summary.cut_force_over_max_n, 400.0, 1e-9);
}

TEST(counts_cuts_alone) {
  CutForceFigures figures(in_layers_falling(0.0));
  figures.add(sample_of(StepKind::kDig, 1.0, 9000.0, 0.0));
  figures.add(sample_of(StepKind::kSwing, 0.5, 9000.0, 0.0));
  figures.add(sample_of(StepKind::kDig, 0.5, AutodigSample::kUnknown, 0.0));
  assert_true(std::isnan(told(figures).cut_force_over_n));
  assert_true(std::isnan(told(figures).cut_force_over_max_n));
  figures.add(sample_of(StepKind::kDig, 0.5, 0.0, 0.0));
  assert_near(told(figures).cut_force_over_n, 0.0, 1e-12);
}

/// A step that is dug along its own line has no force that it gives way to.
TEST(a_program_without_layers_has_none) {
  TaskProgram program = in_layers_falling(0.0);
  program.layers.step = -1;
  CutForceFigures figures(program);
  figures.add(sample_of(StepKind::kDig, 0.5, 9000.0, 0.0));
  assert_true(std::isnan(told(figures).cut_force_over_n));
}
