// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A figure over days: which way it goes, and whether that is more than its noise.

#include <cstddef>
#include <vector>

namespace graben::identify {

/// One figure of one log.
struct DayValue {
  double time_s = 0.0;
  double value = 0.0;
  double deviation = 0.0;
};

/// A straight line through the days, by the median of all slopes: one bad log bends it little.
struct Trend {
  bool known = false;  ///< Five logs and more, a day apart and more.
  double first = 0.0;  ///< Of the line, at the first log and the last.
  double last = 0.0;
  // Standard deviation of the difference of both: by what single values are said to be off by, and
  // by how they scatter about the line.
  double said_noise = 0.0;
  double seen_noise = 0.0;

  [[nodiscard]] double change() const { return last - first; }
  [[nodiscard]] double noise() const { return said_noise > seen_noise ? said_noise : seen_noise; }
  /// The change is so much more than both that of a thousand days without one few would have it:
  /// of few logs their scatter itself is hardly known.
  [[nodiscard]] bool is_beyond_noise(std::size_t logs) const;
};

/// Fewest logs of a trend, and least time between its first and last.
inline constexpr std::size_t kFewestLogs = 5;
inline constexpr double kShortestTrend_s = 86400.0;

/// What a single value is off by: so much of what is said of it, and no less than that.
struct DayNoise {
  double least = 0.0;
  double of_said = 1.0;
};

/// Of values in the order of their times.
[[nodiscard]] Trend trend_of(const std::vector<DayValue>& values, const DayNoise& noise);

}  // namespace graben::identify
