// SPDX-License-Identifier: Apache-2.0
#include "app/runs/cut_force_figures.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/excavator/motion/dig/layer_pose.hpp"

namespace graben::runs {

CutForceFigures::CutForceFigures(const TaskProgram& program) : counts_(in_layers(program)) {
  if (!counts_) {
    return;
  }
  allowed_n_ = program.layers.force_n;
  const Eigen::Vector3d& way_m =
      program.step[static_cast<unsigned>(program.layers.step)].line.line.change.position_m;
  // A cut leads inwards, so the ground pushes outwards.
  against_ = Eigen::Vector2d(way_m.head<2>().norm(), -way_m.z()).normalized();
}

void CutForceFigures::add(const AutodigSample& sample) {
  // Lifts, which are of the same step, tell a share of 1.
  const bool cuts =
      counts_ && sample.progress.kind == StepKind::kDig && sample.progress_share < 1.0;
  if (!cuts || !std::isfinite(sample.tip_force_n[0])) {
    return;
  }
  const double force_n = against_.dot(Eigen::Vector2d(sample.tip_force_n.data()));
  const double over_n = std::max(0.0, force_n - allowed_n_);
  squares_ += over_n * over_n;
  largest_n_ = std::max(largest_n_, over_n);
  ++cycles_;
}

void CutForceFigures::tell(AutodigSummary& summary) const {
  if (cycles_ > 0) {
    summary.cut_force_over_n = std::sqrt(squares_ / static_cast<double>(cycles_));
    summary.cut_force_over_max_n = largest_n_;
  }
}

}  // namespace graben::runs
