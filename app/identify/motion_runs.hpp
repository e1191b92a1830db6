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
  std::array<std::vector<double>, kJoints> velocity_radps;  ///< Measured, or of the angles.
  /// Velocities are the angle's mean rate since this row, where `by_angle` says so: what a model
  /// predicts is then averaged alike, and no filter stands between both. Empty: none does.
  std::vector<std::size_t> since;
  std::array<bool, kJoints> by_angle{};

  [[nodiscard]] std::size_t size() const { return time_s.size(); }
};

/// Reads a CSV file, plain or gzip: columns `run`, `time_s` and, for every joint,
/// `command_permille_JOINT` and `angle_rad_JOINT`, and maybe `velocity_radps_JOINT`; others are not
/// looked at. A velocity that is missing, or only a filtered difference of the angles, is made of
/// the angles. Ratios and per cent for per mille, degrees for radians and ms for s are taken for
/// what they are; `notes`, unless null, gets a sentence for each. Throws std::runtime_error with
/// file, line and column where a value is no number or out of its range, time does not increase or
/// jumps, a run is too short, or an angle is not where its velocity leads.
[[nodiscard]] std::vector<MotionRun> read_motion_csv(const std::string& path,
                                                     std::vector<std::string>* notes = nullptr);

/// The runs of all files. Throws as read_motion_csv does.
[[nodiscard]] std::vector<MotionRun> read_motion_files(const std::vector<std::string>& paths,
                                                       std::vector<std::string>* notes = nullptr);

/// The joint's velocity becomes its angle's mean rate over kTurnWindow_s.
inline constexpr double kTurnWindow_s = 0.1;
void take_velocity_of_angle(MotionRun& run, std::size_t joint);

/// Share of a joint's way, 0 .. 1, that it went while no command had been there for a second.
[[nodiscard]] double unasked_share(const std::vector<MotionRun>& runs, std::size_t joint);

/// Few long runs as many of kPiece_s, and rows that follow each other faster than fits need as
/// fewer, whose commands are means: as many as can be fitted in a minute or two. `notes` as above.
[[nodiscard]] std::vector<MotionRun> cut_and_thinned(std::vector<MotionRun> runs,
                                                     std::vector<std::string>* notes = nullptr);

}  // namespace graben::identify
