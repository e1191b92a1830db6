// SPDX-License-Identifier: Apache-2.0
#include "tests/faults/rolling_watch.hpp"

#include <algorithm>
#include <cmath>

namespace graben::faults {
namespace {
/// Slower than this it stands, as the parking brake has it of a track.
constexpr double kAtRest_mps = 0.05;
}  // namespace

std::size_t RollingWatch::cycles_to_rest() const {
  const auto last = std::find_if(seen_.rbegin(), seen_.rend(), [](const Rolling& rolling) {
    return std::abs(rolling.fastest_mps) > kAtRest_mps;
  });
  return static_cast<std::size_t>(seen_.rend() - last);
}

TimeUs RollingWatch::rest_us() const { return kCycle_us * static_cast<TimeUs>(cycles_to_rest()); }

double RollingWatch::rolled_m() const {
  double rolled_m = 0.0;
  for (std::size_t n = 0; n < std::min(cycles_to_rest() + 1, seen_.size()); ++n) {
    rolled_m = std::max(rolled_m, std::abs(seen_[n].position_m - seen_[0].position_m));
  }
  return rolled_m;
}

double RollingWatch::moved_at_rest_m() const {
  double moved_m = 0.0;
  for (std::size_t n = cycles_to_rest(); n < seen_.size(); ++n) {
    moved_m = std::max(moved_m, std::abs(seen_[n].position_m - seen_.back().position_m));
  }
  return moved_m;
}

}  // namespace graben::faults
