// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Rests in a candump log of a machine with IMUs on its links: stretches in which none of them
/// turned, and where each IMU had gravity then.

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "firmware/excavator/excavator_profile.hpp"

namespace graben::identify {

/// Shorter ones are none: the noise of a running machine has to average out.
inline constexpr double kShortestRest_s = 3.0;

struct Rest {
  double begin_s = 0.0;  ///< Since the log's first frame, once the links have settled.
  double length_s = 0.0;
  std::size_t line = 0;  ///< Of the log, where it begins.
  /// Of each link (or the rocker) against the horizontal, rad, by the turn that the profile has.
  std::array<double, kAxisCount> angle_rad{};
  std::array<double, kAxisCount> deviation_rad{};  ///< Of that mean, by its own scatter.
  /// By so much the second half differs from the first: a link that sank.
  std::array<double, kAxisCount> turned_rad{};
};

struct RestLog {
  std::string name;                ///< Of the file.
  std::string sha256;              ///< Of its bytes, hexadecimal.
  std::uint32_t profile_hash = 0;  ///< That the machine said; 0: it said none.
  double length_s = 0.0;
  std::vector<Rest> rests;
  std::vector<std::string> notes;  ///< LogRead's.
};

/// Reads a log, plain or gzip. Throws std::runtime_error that names file, line and reason: not
/// candump, cut off, an IMU of `imus` that is not heard or is silent too long, one that says an
/// error, two machines in one log, no rest.
[[nodiscard]] RestLog read_rests(const std::filesystem::path& file, const ImuProfile& imus);

}  // namespace graben::identify
