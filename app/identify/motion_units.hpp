// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Recorded motion in the units that its columns say, where the numbers are in others.

#include <array>
#include <string>
#include <vector>

#include "app/identify/motion_runs.hpp"

namespace graben::identify {

/// A run as its rows have it: times in any unit, commands as numbers, before any check.
struct RawRun {
  MotionRun run;
  std::vector<std::size_t> line;  ///< Of the file.
};

/// Which joints have a column of velocity.
using HasVelocity = std::array<bool, kJoints>;

/// Times to s, commands to -1 .. 1, angles to rad, velocities to rad/s, for the whole file alike.
/// `notes` gets a sentence for each that was not as its column says.
void take_units(std::vector<RawRun>& runs, const HasVelocity& has_velocity, const std::string& path,
                std::vector<std::string>& notes);

/// The velocity says nothing that a filtered difference of the angles does not: within what is
/// left of it when that is taken away there is no sensor's noise.
[[nodiscard]] bool is_differenced(const std::vector<MotionRun>& runs, std::size_t joint);

}  // namespace graben::identify
