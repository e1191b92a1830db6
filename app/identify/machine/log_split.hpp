// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Which part of the logs a profile is fitted to, and which part, left out whole, judges it.

#include <vector>

#include "app/identify/machine/machine_log.hpp"

namespace graben::identify {

/// Grid points [begin, end) of a segment.
struct LogStretch {
  std::size_t log = 0;
  std::size_t segment = 0;
  std::size_t begin = 0;
  std::size_t end = 0;
};

struct LogSplit {
  std::vector<MachineLog> fitted;  ///< Without what judges.
  std::vector<LogStretch> judged;  ///< Of the logs that were split.
  double fitted_s = 0.0;           ///< Time in motion of both.
  double judged_s = 0.0;
};

/// Of several logs the last one judges. Of one log it is every fifth stretch of kStretch_s with
/// motion in it, counted for each drive and direction by itself, so that whatever moves is judged.
/// Throws std::runtime_error where there is less motion than that takes.
[[nodiscard]] LogSplit split_logs(const std::vector<MachineLog>& logs);

/// All stretches with motion in them, of whatever log.
[[nodiscard]] std::vector<LogStretch> moving_stretches(const std::vector<MachineLog>& logs);

inline constexpr double kStretch_s = 5.0;

}  // namespace graben::identify
