// SPDX-License-Identifier: Apache-2.0
#include "app/identify/verdict/mended_signals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace graben::identify {
namespace {

constexpr double kFarOff = 3.0;       // Of the span of all other values.
constexpr double kMostStrange = 0.4;  // Of the values; more of them are the log's own.
constexpr int kMostMarks = 3;         // Numbers that stand for no value.

/// The least or the most of the values, where it is far off all others; else NaN.
double mark_of(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  for (const double mark : {*low, *high}) {
    double least = std::numeric_limits<double>::infinity();
    double most = -least;
    std::size_t count = 0;
    for (const double value : values) {
      if (value == mark) {
        ++count;
      } else {
        least = std::min(least, value);
        most = std::max(most, value);
      }
    }
    const double off = mark > most ? mark - most : least - mark;
    if (most > least && off > kFarOff * (most - least) &&
        static_cast<double>(count) < kMostStrange * static_cast<double>(values.size())) {
      return mark;
    }
  }
  return kNoNumber;
}

void drop_marks(Signal& signal, std::vector<std::string>& notes) {
  for (int n = 0; n < kMostMarks && signal.value.size() > 2; ++n) {
    const double mark = mark_of(signal.value);
    if (!std::isfinite(mark)) {
      return;
    }
    std::size_t kept = 0;
    for (std::size_t at = 0; at < signal.value.size(); ++at) {
      if (signal.value[at] != mark) {
        signal.value[kept] = signal.value[at];
        signal.time_s[kept++] = signal.time_s[at];
      }
    }
    const std::size_t dropped = signal.value.size() - kept;
    notes.push_back(
        fmt::format("{}: {} of its {} values are {:g}, far off all others: taken for "
                    "\"no value\"",
                    signal.name, dropped, signal.value.size(), mark));
    signal.invalid += dropped;
    signal.value.resize(kept);
    signal.time_s.resize(kept);
  }
}

struct Turn {
  Unit unit;
  double whole;
};
constexpr std::array<Turn, 3> kTurns = {Turn{Unit::kRad, 6.283185307179586},
                                        Turn{Unit::kDegree, 360.0},
                                        Turn{Unit::kMrad, 6283.185307179586}};

/// An angle that jumps by nearly a full turn at once went on.
void unwind(Signal& signal, std::vector<std::string>& notes) {
  constexpr double kNearly = 0.8;
  constexpr double kOver = 1.01;
  const auto [low, high] = std::minmax_element(signal.value.begin(), signal.value.end());
  const double span = *high - *low;
  const auto turn = std::find_if(kTurns.begin(), kTurns.end(), [&](const Turn& each) {
    return span > kNearly * each.whole && span < kOver * each.whole;
  });
  if (turn == kTurns.end()) {
    return;
  }
  double added = 0.0;
  double last = signal.value.front();
  std::size_t wraps = 0;
  for (double& value : signal.value) {
    const double step = value - last;
    last = value;
    if (std::abs(step) > kNearly * turn->whole) {
      added -= std::copysign(turn->whole, step);
      ++wraps;
    }
    value += added;
  }
  if (wraps > 0) {
    signal.meaning.unit = turn->unit;
    notes.push_back(fmt::format("{}: wraps {} times at a full turn, {:.4g}: counted on",
                                signal.name, wraps, turn->whole));
  }
}

bool goes_both_ways(const Signal& signal) {
  constexpr double kSome = 0.05;
  const auto [low, high] = std::minmax_element(signal.value.begin(), signal.value.end());
  return *low<-kSome* * high&& * high> - kSome * *low;
}

}  // namespace

void mend_signals(SignalLog& log) {
  for (Signal& signal : log.signals) {
    Meaning& meaning = signal.meaning;
    if (meaning.drive < 0 || signal.value.size() < 2) {
      continue;
    }
    if (meaning.what == What::kPosition) {
      drop_marks(signal, log.notes);
      if (!meaning.length) {
        unwind(signal, log.notes);
      }
    } else if ((meaning.what == What::kCommand || meaning.what == What::kSpool) &&
               meaning.side != 0 && goes_both_ways(signal)) {
      meaning.side = 0;
    }
  }
}

}  // namespace graben::identify
