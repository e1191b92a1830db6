// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Recorded motion of an excavator without profile: commands and what the joints did.

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace graben::identify {

inline constexpr std::size_t kJoints = 4;
inline constexpr std::array<const char*, kJoints> kJointNames = {"boom", "arm", "bucket", "swing"};

/// One run without a break. All vectors have the length of `time_s`.
struct MotionRun {
  std::string name;                                         ///< Its file and the number in it.
  std::vector<double> time_s;                               ///< Increasing.
  std::array<std::vector<double>, kJoints> command;         ///< -1 .. 1, held until the next row.
  std::array<std::vector<double>, kJoints> angle_rad;       ///< Measured.
  std::array<std::vector<double>, kJoints> velocity_radps;  ///< Measured.

  [[nodiscard]] std::size_t size() const { return time_s.size(); }
};

/// Reads a CSV file, plain or gzip: columns `run`, `time_s` and, for every joint,
/// `command_permille_JOINT`, `angle_rad_JOINT` and `velocity_radps_JOINT`; others are not looked
/// at. Throws std::runtime_error with file, line and column where a value is no number or out of
/// its range, time does not increase or jumps, a run is too short, or an angle is not where its
/// velocity leads.
[[nodiscard]] std::vector<MotionRun> read_motion_csv(const std::string& path);

/// The runs of all files. Throws as read_motion_csv does.
[[nodiscard]] std::vector<MotionRun> read_motion_files(const std::vector<std::string>& paths);

}  // namespace graben::identify
