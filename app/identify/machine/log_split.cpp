// SPDX-License-Identifier: Apache-2.0
#include "app/identify/machine/log_split.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace graben::identify {
namespace {

constexpr auto kStretch = static_cast<std::size_t>(kStretch_s / kGrid_s + 0.5);
constexpr std::size_t kEvery = 5;
/// The one of five that judges: so three stretches of a side are enough for one.
constexpr std::size_t kJudges = 2;
constexpr double kMoves_m = 0.01;
/// Shorter than this, what is left between two stretches says nothing.
constexpr std::size_t kShortest = 100;
constexpr std::size_t kLeastStretches = 4;
constexpr std::size_t kSides = 2 * kDriveCount;

struct Motion {
  bool moves = false;
  std::size_t side = 0;  ///< That goes farthest.
};

Motion motion_of(const LogSegment& segment, std::size_t begin, std::size_t end) {
  Motion motion;
  double most_m = kMoves_m;
  for (std::size_t axis = 0; axis < segment.drives; ++axis) {
    const CylinderSeries& series = segment.axis[axis];
    std::array<double, 2> way_m{};
    for (std::size_t at = begin + 1; at < end; ++at) {
      const double step_m = series.stroke_m[at] - series.stroke_m[at - 1];
      if (series.duty[at] != 0.0 || series.spool[at] != 0.0) {
        way_m[step_m > 0.0 ? 0 : 1] += std::abs(step_m);
      }
    }
    for (std::size_t direction = 0; direction < 2; ++direction) {
      if (way_m[direction] > most_m) {
        most_m = way_m[direction];
        motion = {true, 2 * axis + direction};
      }
    }
  }
  return motion;
}

std::vector<Reading> between(const std::vector<Reading>& readings, double begin_s, double end_s) {
  std::vector<Reading> part;
  for (const Reading& reading : readings) {
    if (reading.time_s >= begin_s && reading.time_s < end_s) {
      part.push_back({reading.time_s - begin_s, reading.value});
    }
  }
  return part;
}

LogSegment part_of(const LogSegment& segment, std::size_t begin, std::size_t end) {
  const auto cut = [&](std::vector<double>& values) {
    values = {values.begin() + static_cast<std::ptrdiff_t>(begin),
              values.begin() + static_cast<std::ptrdiff_t>(end)};
  };
  const double begin_s = kGrid_s * static_cast<double>(begin);
  const double end_s = kGrid_s * static_cast<double>(end);
  LogSegment part = segment;
  part.begin_s += begin_s;
  for (std::size_t k = 0; k < part.drives; ++k) {
    CylinderSeries& axis = part.axis[k];
    for (std::vector<double>* values :
         {&axis.duty, &axis.spool, &axis.stroke_m, &axis.cap_pa, &axis.rod_pa}) {
      cut(*values);
    }
    axis.duties = between(axis.duties, begin_s, end_s);
    axis.spools = between(axis.spools, begin_s, end_s);
  }
  for (std::vector<double>& values : part.swash) {
    cut(values);
  }
  cut(part.engine_radps);
  return part;
}

/// The log without these stretches of it, which come in rising order.
MachineLog without(const MachineLog& log, const std::vector<LogStretch>& judged) {
  MachineLog rest = log;
  rest.segments.clear();
  for (std::size_t n = 0; n < log.segments.size(); ++n) {
    const LogSegment& segment = log.segments[n];
    std::size_t from = 0;
    const auto keep = [&](std::size_t until) {
      if (until >= from + kShortest) {
        rest.segments.push_back(part_of(segment, from, until));
      }
    };
    for (const LogStretch& stretch : judged) {
      if (stretch.segment == n) {
        keep(stretch.begin);
        from = stretch.end;
      }
    }
    keep(segment.size());
  }
  return rest;
}

double length_s(const std::vector<LogStretch>& stretches) {
  double sum_s = 0.0;
  for (const LogStretch& stretch : stretches) {
    sum_s += kGrid_s * static_cast<double>(stretch.end - stretch.begin);
  }
  return sum_s;
}

struct Moving {
  LogStretch stretch;
  std::size_t side = 0;
};

std::vector<Moving> moving_of(const std::vector<MachineLog>& logs) {
  std::vector<Moving> all;
  for (std::size_t l = 0; l < logs.size(); ++l) {
    for (std::size_t n = 0; n < logs[l].segments.size(); ++n) {
      const LogSegment& segment = logs[l].segments[n];
      for (std::size_t begin = 0; begin < segment.size(); begin += kStretch) {
        const std::size_t end = std::min(begin + kStretch, segment.size());
        if (const Motion motion = motion_of(segment, begin, end); motion.moves) {
          all.push_back({{l, n, begin, end}, motion.side});
        }
      }
    }
  }
  return all;
}

[[noreturn]] void refuse(double moving_s) {
  throw std::runtime_error(fmt::format(
      "the logs have {:.0f} s of motion; at least {:.0f} s are needed to fit and to leave some out",
      moving_s, kStretch_s * static_cast<double>(kLeastStretches)));
}

}  // namespace

std::vector<LogStretch> moving_stretches(const std::vector<MachineLog>& logs) {
  std::vector<LogStretch> all;
  for (const Moving& of : moving_of(logs)) {
    all.push_back(of.stretch);
  }
  return all;
}

LogSplit split_logs(const std::vector<MachineLog>& logs) {
  LogSplit split;
  const std::vector<Moving> moving = moving_of(logs);
  std::array<std::size_t, kSides> seen{};
  std::vector<LogStretch> fitted;
  for (const Moving& of : moving) {
    const bool judges =
        logs.size() > 1 ? of.stretch.log + 1 == logs.size() : seen[of.side]++ % kEvery == kJudges;
    (judges ? split.judged : fitted).push_back(of.stretch);
  }
  split.fitted_s = length_s(fitted);
  split.judged_s = length_s(split.judged);
  if (moving.size() < kLeastStretches || fitted.empty() || split.judged.empty()) {
    refuse(split.fitted_s + split.judged_s);
  }
  if (logs.size() > 1) {
    split.fitted = {logs.begin(), logs.end() - 1};
  } else {
    split.fitted = {without(logs.front(), split.judged)};
  }
  return split;
}

}  // namespace graben::identify
