// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Identification from foreign recordings, from files to figures.

#include <array>
#include <string>
#include <vector>

#include "app/identify/motion_fit.hpp"
#include "app/identify/motion_model.hpp"

namespace graben::identify {

/// Which runs a model is made of and which it is judged by.
struct MotionSplit {
  std::vector<MotionRun> train;
  std::vector<MotionRun> judge;
};

/// Takes every fifth run of `train` as judge where there is none. Throws std::runtime_error where a
/// judged run is among the trained ones, under any name, or too few runs are there to leave one
/// out.
[[nodiscard]] MotionSplit split_motion(std::vector<MotionRun> train, std::vector<MotionRun> judge);

struct MotionResult {
  MotionModel model;
  std::array<Score, kJoints> trained;
  std::array<Score, kJoints> judged;
  std::size_t trained_runs = 0;
  std::size_t judged_runs = 0;
  /// Per joint: least and most of its command, of what was trained on.
  std::array<std::array<double, 2>, kJoints> driven{};
};

/// Fits and judges.
[[nodiscard]] MotionResult identify_motion(const MotionSplit& split, const FitOptions& options);

/// Figures as JSON, of the judged runs first: `axes`, per joint `velocity_r2`, `angle_1s_rms_rad`
/// (null where the joint stood), dead time, lags, and both curves with deviations.
[[nodiscard]] std::string motion_json(const MotionResult& result);

/// The same as text, with what the runs say nothing about.
[[nodiscard]] std::string motion_text(const MotionResult& result);

}  // namespace graben::identify
