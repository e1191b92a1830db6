// SPDX-License-Identifier: Apache-2.0
#pragma once
/// True force of the ground on the teeth of a cut, against the force that its plan allows.

#include <Eigen/Core>

#include "app/runs/autodig_run.hpp"

namespace graben::runs {

/// Of samples in their order. Counts what the ground pushes against the cut's line, N, over the
/// plan's `force_n`; less counts as none, for a cut need not use it.
class CutForceFigures {
 public:
  /// A program that does not dig in layers has no such plan: nothing is counted.
  explicit CutForceFigures(const TaskProgram& program);

  void add(const AutodigSample& sample);
  /// Stays not a number where nothing was cut.
  void tell(AutodigSummary& summary) const;

 private:
  bool counts_ = false;
  double allowed_n_ = 0.0;
  Eigen::Vector2d against_ = Eigen::Vector2d::Zero();  ///< Unit, in the plane of the links.
  double squares_ = 0.0;
  double largest_n_ = 0.0;
  long cycles_ = 0;
};

}  // namespace graben::runs
