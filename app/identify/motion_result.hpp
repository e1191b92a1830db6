// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Identification from foreign recordings, from files to figures.

#include <array>
#include <string>
#include <vector>

#include "app/identify/motion_fit.hpp"
#include "app/identify/motion_model.hpp"
#include "app/identify/motion_rivals.hpp"

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
  std::array<double, kJoints> usual_radps{};  ///< Of what was trained on.
  std::array<double, kJoints> unasked{};      ///< Share of the way; see unasked_share().
  std::array<Rivals, kJoints> rivals;         ///< Simple models beside it.
  std::vector<std::string> notes;             ///< Of the recordings: units, cuts.

  /// Which model a joint's velocity is best taken from: "physical" unless it loses by more than
  /// kLoses to one of the simple ones, "curve" or "ridge"; and what that explains.
  [[nodiscard]] const char* chosen(std::size_t joint) const;
  [[nodiscard]] double chosen_r2(std::size_t joint) const;
  /// Some joint moved, and none is explained by more than kUselessR2.
  [[nodiscard]] bool useless() const;
};

inline constexpr double kLoses = 0.005;
inline constexpr double kUselessR2 = 0.3;

/// Fits and judges.
[[nodiscard]] MotionResult identify_motion(const MotionSplit& split, const FitOptions& options);

/// Figures as JSON, of the judged runs first: `axes`, per joint `velocity_r2` of the chosen `model`
/// and that of each, `angle_1s_rms_rad` (null where the joint stood), dead time, total delays,
/// lags, both curves with deviations, and `fitted`, every parameter. What is at its bound has no
/// deviation, a direction that was not driven no curve.
[[nodiscard]] std::string motion_json(const MotionResult& result);

/// The same as text, with what the runs say nothing about.
[[nodiscard]] std::string motion_text(const MotionResult& result);

}  // namespace graben::identify
