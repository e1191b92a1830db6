// SPDX-License-Identifier: Apache-2.0
#include "app/identify/verdict/track_parts.hpp"

#include <algorithm>
#include <cmath>

namespace graben::identify {
namespace {

/// The one with the most values; a second sensor only alone.
const Signal* best_of(const std::vector<const Signal*>& all) {
  const Signal* best = nullptr;
  for (const Signal* signal : all) {
    if (best == nullptr || (best->meaning.second && !signal->meaning.second) ||
        (best->meaning.second == signal->meaning.second &&
         signal->value.size() > best->value.size())) {
      best = signal;
    }
  }
  return best;
}

std::vector<const Signal*> those(const SignalLog& log, int drive, What what, int side) {
  constexpr int kAnySide = 2;
  std::vector<const Signal*> found;
  for (const Signal& signal : log.signals) {
    if (signal.meaning.drive == drive && signal.meaning.what == what && signal.value.size() > 1 &&
        (side == kAnySide || signal.meaning.side == side)) {
      found.push_back(&signal);
    }
  }
  return found;
}

}  // namespace

Parts parts_of(const SignalLog& log, int drive) {
  Parts parts;
  for (const What what : {What::kCommand, What::kSpool}) {
    if (parts.command.empty()) {
      parts.from_spool = what == What::kSpool;
      if (const Signal* both = best_of(those(log, drive, what, 0)); both != nullptr) {
        parts.command = {both};
      } else {
        for (const int side : {1, -1}) {
          if (const Signal* one = best_of(those(log, drive, what, side)); one != nullptr) {
            parts.command.push_back(one);
          }
        }
      }
    }
  }
  parts.position = best_of(those(log, drive, What::kPosition, 2));
  parts.velocity = best_of(those(log, drive, What::kVelocity, 2));
  parts.pressure = those(log, drive, What::kPressure, 2);
  return parts;
}

double jump_share(const Signal& signal) {
  constexpr double kFar = 0.1;  // Of its whole span.
  const auto [least, most] = std::minmax_element(signal.value.begin(), signal.value.end());
  const double far = kFar * (*most - *least);
  std::size_t jumps = 0;
  for (std::size_t at = 2; at < signal.value.size(); ++at) {
    const double one = signal.value[at - 1] - signal.value[at - 2];
    const double other = signal.value[at] - signal.value[at - 1];
    const bool quick = signal.time_s[at] - signal.time_s[at - 2] < 0.2;
    jumps += quick && one * other < 0.0 && std::min(std::abs(one), std::abs(other)) > far ? 1 : 0;
  }
  return static_cast<double>(jumps) / static_cast<double>(signal.value.size());
}

}  // namespace graben::identify
