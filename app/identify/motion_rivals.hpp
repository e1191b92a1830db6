// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What simple models make of the recordings that a machine was identified from, judged by the same
/// rows.

#include <array>
#include <vector>

#include "app/identify/motion_runs.hpp"
#include "app/identify/simple_models.hpp"

namespace graben::identify {

struct Rivals {
  CurveFit curve;
  RidgeFit ridge;
};

/// One for each joint. `train` is fitted to, `judge` judges.
[[nodiscard]] std::array<Rivals, kJoints> fit_rivals(const std::vector<MotionRun>& train,
                                                     const std::vector<MotionRun>& judge);

}  // namespace graben::identify
