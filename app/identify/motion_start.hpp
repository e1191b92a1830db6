// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Where the fit of a joint starts and within what it stays.

#include <cstddef>
#include <vector>

#include "app/identify/motion_model.hpp"

namespace graben::identify {

/// Of a parameter. A deviation from `start` by `wide` costs as much as a row that is off by the
/// joint's usual velocity: it keeps what the data says nothing of, and parameters that can stand
/// for each other, where they started.
struct Range {
  double least;
  double start;
  double most;
  double wide;
};

/// `usual_radps` is the rms velocity of the joint.
[[nodiscard]] Range range(std::size_t parameter, double usual_radps);

/// Rms velocity of a joint, rad/s.
[[nodiscard]] double usual_velocity(const std::vector<MotionRun>& runs, std::size_t joint);

/// Sign, grid and starting values of a joint, from its runs.
[[nodiscard]] JointModel start_model(const std::vector<MotionRun>& runs, std::size_t joint);

/// Moves the bends of both curves to where they open and where the commands are, half and half: a
/// curve must not be coarse where few commands are. Leaves the curves where they were.
void spread_bends(const std::vector<MotionRun>& runs, std::size_t joint, JointModel& model);

}  // namespace graben::identify
