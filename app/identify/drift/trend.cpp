// SPDX-License-Identifier: Apache-2.0
#include "app/identify/drift/trend.hpp"

#include <algorithm>
#include <cmath>

namespace graben::identify {
namespace {

constexpr double kOfSquares = 0.7;
constexpr double kNormal = 1.4826;  // Standard deviation over median of absolute values.

/// Of an even number the mean of both in the middle: the upper one would bend the line.
double median(std::vector<double> values) {
  const std::size_t half = values.size() / 2;
  std::sort(values.begin(), values.end());
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

}  // namespace

bool Trend::is_beyond_noise(std::size_t logs) const {
  constexpr double kSaid = 5.0;
  constexpr double kSeen = 4.0;
  constexpr double kFew = 12.0;
  const double seen = kSeen + kFew / static_cast<double>(logs - 2);
  return known && std::abs(change()) > kSaid * said_noise && std::abs(change()) > seen * seen_noise;
}

Trend trend_of(const std::vector<DayValue>& values, const DayNoise& noise) {
  Trend trend;
  if (values.size() < kFewestLogs ||
      values.back().time_s - values.front().time_s < kShortestTrend_s) {
    return trend;
  }
  std::vector<double> slopes;
  double middle_s = 0.0;
  for (std::size_t a = 0; a < values.size(); ++a) {
    middle_s += values[a].time_s / static_cast<double>(values.size());
    for (std::size_t b = a + 1; b < values.size(); ++b) {
      const double apart_s = values[b].time_s - values[a].time_s;
      if (apart_s > 0.0) {
        slopes.push_back((values[b].value - values[a].value) / apart_s);
      }
    }
  }
  const double slope = median(slopes);
  std::vector<double> places;
  std::vector<double> said;
  double spread_s2 = 0.0;
  for (const DayValue& value : values) {
    const double since_s = value.time_s - middle_s;
    spread_s2 += since_s * since_s;
    places.push_back(value.value - slope * since_s);
    said.push_back(value.deviation);
  }
  const double middle = median(places);
  std::vector<double> off;
  double squares = 0.0;
  for (const double place : places) {
    off.push_back(std::abs(place - middle));
    squares += (place - middle) * (place - middle);
  }
  // Two of the values made the line. One bad log hides little, and few that lie on it by chance
  // prove nothing.
  const auto count = static_cast<double>(values.size());
  const double seen = std::max(kNormal * median(off) * std::sqrt(count / (count - 2.0)),
                               kOfSquares * std::sqrt(squares / (count - 2.0)));
  const double span_s = values.back().time_s - values.front().time_s;
  trend.known = true;
  trend.first = middle + slope * (values.front().time_s - middle_s);
  trend.last = middle + slope * (values.back().time_s - middle_s);
  const double of_change = span_s / std::sqrt(spread_s2);
  trend.said_noise = of_change * std::max(noise.least, noise.of_said * median(said));
  trend.seen_noise = of_change * seen;
  return trend;
}

}  // namespace graben::identify
