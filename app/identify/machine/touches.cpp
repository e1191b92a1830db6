// SPDX-License-Identifier: Apache-2.0
#include "app/identify/machine/touches.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "app/identify/machine/clipped_pressure.hpp"
#include "app/identify/machine/median.hpp"

namespace graben::identify {
namespace {

/// A touch lasts so long, in grid points. Its last part counts: before that oil still drains.
constexpr std::size_t kTouch = 40;
constexpr std::size_t kLast = 24;
constexpr double kStill_m = 0.0004;
/// Farther from its end no sensor's zero is.
constexpr double kNear_m = 0.035;
/// It moves.
constexpr double kMoves_mps = 0.008;
/// It came this far on its way to the end.
constexpr double kCame_m = 0.003;
/// ... within so many grid points, cushion and all.
constexpr std::size_t kCame = 600;
/// The pushing side has at least that more than the other.
constexpr double kPushes_pa = 3.0e6;
constexpr double kStrokeDeviation_m = 0.0003;
/// An empty chamber is not quite at the tank's pressure.
constexpr double kPressureDeviation_pa = 0.1e6;
constexpr double kMostZero_pa = 2.0e6;
/// A transducer's resolution, where its noise is less.
constexpr double kLeastNoise_pa = 0.02e6;
/// A touch whose mean is so much above the lowest was not empty yet.
constexpr double kEmptier_pa = 0.3e6;
/// Where the zero is below what the sensor shows: half of the usual bound, and what is open then.
constexpr double kBelow_pa = -0.6e6;
constexpr double kBelowDeviation_pa = 0.4e6;
/// A stroke that is shown as 0 may be less.
constexpr double kNoStroke_m = 0.0002;

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) {
    sum += value;
  }
  return sum / static_cast<double>(values.size());
}

std::vector<double> part(const std::vector<double>& of, std::size_t from, std::size_t until) {
  return {of.begin() + static_cast<std::ptrdiff_t>(from),
          of.begin() + static_cast<std::ptrdiff_t>(until)};
}

/// For so many grid points before `at`, of a touch of this length, the drained side is as empty as
/// in the end.
std::size_t empty_for(const std::vector<double>& drained_pa, std::size_t at, std::size_t length) {
  const double last_pa = mean(part(drained_pa, at - kLast, at));
  std::size_t back = kLast;
  while (back + kLast / 2 <= length &&
         mean(part(drained_pa, at - back - kLast / 2, at - back)) < last_pa + kEmptier_pa) {
    back += kLast / 2;
  }
  return back;
}

struct Touch {
  double stroke_m = 0.0;
  std::vector<double> drained_pa;
};

/// Readings of the touches of one end.
std::vector<Touch> touches(const std::vector<MachineLog>& logs, std::size_t axis, bool extends,
                           double end_m, double open) {
  std::vector<Touch> found;
  for (const MachineLog& log : logs) {
    for (const LogSegment& segment : log.segments) {
      const CylinderSeries& series = segment.axis[axis];
      for (std::size_t at = kTouch; at + 1 < segment.size(); ++at) {
        const double sign = extends ? 1.0 : -1.0;
        const auto is_pressed = [&](std::size_t k) {
          return sign * series.spool[k] > open &&
                 std::abs(series.stroke_m[k] - series.stroke_m[at]) < kStill_m;
        };
        if (std::abs(series.stroke_m[at] - end_m) > kNear_m || is_pressed(at + 1)) {
          continue;  // Elsewhere, or not its last moment.
        }
        std::size_t length = 0;
        while (length < at && is_pressed(at - length)) {
          ++length;
        }
        const std::size_t before = at - std::min(at, length + kCame);
        if (length < kTouch || sign * (series.stroke_m[at] - series.stroke_m[before]) < kCame_m) {
          continue;
        }
        const std::vector<double>& fed = extends ? series.cap_pa : series.rod_pa;
        const std::vector<double>& drained = extends ? series.rod_pa : series.cap_pa;
        const std::size_t from = at - empty_for(drained, at, length);
        Touch touch = {series.stroke_m[at], part(drained, from, at)};
        if (median(part(fed, from, at)) - median(touch.drained_pa) > kPushes_pa) {
          found.push_back(std::move(touch));
        }
      }
    }
  }
  return found;
}

/// Least travel at which a steady point of this side moved.
double least_open(const std::vector<SteadyPoint>& points, std::size_t axis, bool extends) {
  double least = 1.0;
  for (const SteadyPoint& point : points) {
    const bool is_side = point.axis == static_cast<int>(axis) && (point.spool > 0.0) == extends;
    if (is_side && (extends ? point.speed_mps : -point.speed_mps) > kMoves_mps) {
      least = std::min(least, std::abs(point.spool));
    }
  }
  return least;
}

Estimate zero_of(const std::vector<Touch>& found, double noise_pa, const Estimate& before) {
  if (found.empty()) {
    return before;
  }
  double lowest_pa = mean(found.front().drained_pa);
  for (const Touch& touch : found) {
    lowest_pa = std::min(lowest_pa, mean(touch.drained_pa));
  }
  std::vector<double> readings_pa;
  for (const Touch& touch : found) {
    if (mean(touch.drained_pa) <= lowest_pa + kEmptier_pa) {
      readings_pa.insert(readings_pa.end(), touch.drained_pa.begin(), touch.drained_pa.end());
    }
  }
  const std::optional<ClippedZero> zero = clipped_zero(readings_pa, noise_pa);
  if (!zero) {
    return {kBelow_pa, kBelowDeviation_pa, false};
  }
  if (zero->value_pa > kMostZero_pa) {
    return before;  // Its draining side was not open.
  }
  return {zero->value_pa, std::hypot(kPressureDeviation_pa, zero->deviation_pa), true};
}

}  // namespace

void find_zeros(const std::vector<MachineLog>& logs, const DriveModel& model,
                const std::vector<SteadyPoint>& points, MachineEstimate& machine) {
  for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
    DriveEstimate& drive = machine.drive[axis];
    const double most_m = model.drive[axis].most_travel_m;
    const std::vector<Touch> out =
        touches(logs, axis, true, most_m, least_open(points, axis, true));
    const std::vector<Touch> in = touches(logs, axis, false, 0.0, least_open(points, axis, false));
    const double noise_pa = std::max(kLeastNoise_pa, pressure_noise_pa(logs, axis));
    drive.rod_zero_pa = zero_of(out, noise_pa, drive.rod_zero_pa);
    drive.cap_zero_pa = zero_of(in, noise_pa, drive.cap_zero_pa);
    if (!out.empty()) {
      drive.stroke_zero_m = {out.back().stroke_m - most_m, kStrokeDeviation_m, true};
    } else if (!in.empty() && in.back().stroke_m > kNoStroke_m) {
      drive.stroke_zero_m = {in.back().stroke_m, kStrokeDeviation_m, true};
    }
  }
}

}  // namespace graben::identify
