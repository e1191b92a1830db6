// SPDX-License-Identifier: Apache-2.0
#include "app/identify/verdict/track_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/identify/verdict/track_figures.hpp"

namespace graben::identify {
namespace {

/// The one with the most values; a second sensor only alone. A share is better than a current or a
/// speed that was asked for.
const Signal* best_of(const std::vector<const Signal*>& all) {
  const Signal* best = nullptr;
  for (const Signal* signal : all) {
    if (best == nullptr || (best->meaning.second && !signal->meaning.second) ||
        (best->meaning.second == signal->meaning.second &&
         (signal->value.size() > best->value.size() ||
          (signal->value.size() == best->value.size() && best->meaning.unit == Unit::kOther &&
           signal->meaning.unit != Unit::kOther)))) {
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
  parts.drive = drive;
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

void say_unused(const SignalLog& log, const std::vector<Parts>& parts,
                std::vector<std::string>& notes) {
  constexpr std::size_t kNamed = 8;
  std::vector<std::string> unused;
  for (const Parts& of : parts) {
    std::vector<const Signal*> used = of.command;
    for (const Signal* motion : {of.position, of.velocity}) {
      if (motion != nullptr) {
        used.push_back(motion);
      }
    }
    for (const Signal& signal : log.signals) {
      const bool rivals = std::any_of(used.begin(), used.end(), [&](const Signal* other) {
        return other != &signal && other->meaning.what == signal.meaning.what;
      });
      if (signal.meaning.drive == of.drive && rivals && signal.value.size() > 1 &&
          std::find(used.begin(), used.end(), &signal) == used.end()) {
        unused.push_back(signal.name);
      }
    }
  }
  if (!unused.empty()) {
    const std::size_t more = unused.size() > kNamed ? unused.size() - kNamed : 0;
    unused.resize(unused.size() - more);
    notes.push_back(
        fmt::format("of several that could be the same of a drive one counts; not used: {}{}",
                    fmt::join(unused, ", "), more == 0 ? "" : fmt::format(", and {} more", more)));
  }
}

double longest_step(double usual_s) {
  constexpr double kUsualGap = 8.0;  // Of the usual step, of slow recordings.
  return std::min(0.9 * kCut_s, std::max(kGap_s, kUsualGap * usual_s));
}

/// Rows between values that are further apart than values are, and just after them.
std::vector<char> blind_rows(const Signal* motion, const std::vector<double>& time_s) {
  std::vector<char> blind(time_s.size(), 0);
  if (motion == nullptr) {
    return blind;
  }
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const std::vector<double>& times = motion->time_s;
  const double longest_s = longest_step(usual_step(times));
  auto next = std::upper_bound(times.begin(), times.end(), time_s.front());
  double seen_s = next == times.begin() ? -kNever : *(next - 1);
  double gap_end_s = -kNever;
  for (std::size_t row = 0; row < time_s.size(); ++row) {
    for (; next != times.end() && *next <= time_s[row]; ++next) {
      gap_end_s = *next - seen_s > longest_s ? *next : gap_end_s;
      seen_s = *next;
    }
    const double until_s = next == times.end() ? kNever : *next;
    const bool in_gap = until_s - seen_s > longest_s && time_s[row] > seen_s;
    blind[row] = in_gap || time_s[row] - gap_end_s < kWindow_s ? 1 : 0;
  }
  return blind;
}

}  // namespace graben::identify
