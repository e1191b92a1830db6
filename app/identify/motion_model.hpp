// SPDX-License-Identifier: Apache-2.0
#pragma once
/// All joints of a machine: their models, what they predict and how well.

#include <array>
#include <string>
#include <vector>

#include "app/identify/joint_model.hpp"
#include "app/identify/motion_runs.hpp"

namespace graben::identify {

/// One joint. `sign` is the velocity's for a positive command.
struct JointModel {
  double sign = 1.0;
  Grid grid{};
  std::array<double, kParameters> value{};
  /// Standard deviations; infinite where the data says nothing. Not valid for a value at its bound:
  /// see at_bound().
  std::array<double, kParameters> deviation{};
};

using MotionModel = std::array<JointModel, kJoints>;

/// Per joint and row of a run, rad/s.
using Velocities = std::array<std::vector<double>, kJoints>;

/// Velocities of a run from its commands and its measured pose.
[[nodiscard]] Velocities predict(const MotionModel& model, const MotionRun& run);

/// The same as the run's velocities are: of the angles where those are.
[[nodiscard]] Velocities predict_measured(const MotionModel& model, const MotionRun& run);

/// How far each joint turns within the second after each row, rad, from the commands and the pose
/// at that row alone: shorter than the run by that second.
[[nodiscard]] Velocities turns_ahead(const MotionModel& model, const MotionRun& run);

/// How good a prediction is, over all rows of all runs.
struct Score {
  double velocity_r2 = 0.0;         ///< Share of the velocity's variance that is explained.
  double angle_1s_rms_rad = 0.0;    ///< Of turns_ahead().
  double velocity_rms_radps = 0.0;  ///< Unexplained.
  bool moved = false;               ///< False: the joint stood, and there is nothing to explain.
};

/// Below this rms velocity a joint stands, rad/s.
inline constexpr double kStands_radps = 0.005;

/// One score per joint.
[[nodiscard]] std::array<Score, kJoints> judge(const MotionModel& model,
                                               const std::vector<MotionRun>& runs);

/// Inputs of a joint's model for one run: pose, the others' openings and their velocities, which
/// are zero where `rates` is null.
[[nodiscard]] JointRun joint_run(const MotionModel& model, std::size_t joint, const MotionRun& run,
                                 const Velocities* rates);

}  // namespace graben::identify
