#include "app/identify/machine/touches.hpp"

#include <algorithm>
#include <cmath>

namespace graben::identify {
namespace {

/// A touch lasts so long, in grid points; its first part is the oil's way to rest.
constexpr std::size_t kTouch = 40;
constexpr std::size_t kSettled = 20;
constexpr double kStill_m = 0.0004;
/// Farther from its end no sensor's zero is.
constexpr double kNear_m = 0.035;
/// It moves.
constexpr double kMoves_mps = 0.008;
/// It came this far on its way to the end.
constexpr double kCame_m = 0.01;
/// ... within so many grid points, cushion and all.
constexpr std::size_t kCame = 300;
/// The pushing side has at least that more than the other.
constexpr double kPushes_pa = 3.0e6;
constexpr double kStrokeDeviation_m = 0.0003;
constexpr double kPressureDeviation_pa = 0.1e6;
constexpr double kMostZero_pa = 2.0e6;
/// A reading of less is the transducer's end.
constexpr double kNothing_pa = 0.03e6;
/// Where the zero is below what the sensor shows: half of the usual bound, and what is open then.
constexpr double kBelow_pa = -0.6e6;
constexpr double kBelowDeviation_pa = 0.4e6;
/// A stroke that is shown as 0 may be less.
constexpr double kNoStroke_m = 0.0002;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

struct Touch {
  double stroke_m = 0.0;
  double drained_pa = 0.0;
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
        const auto from = static_cast<std::ptrdiff_t>(at - length + kSettled);
        const auto until = static_cast<std::ptrdiff_t>(at);
        const double fed_pa = median({fed.begin() + from, fed.begin() + until});
        const double drained_pa = median({drained.begin() + from, drained.begin() + until});
        if (fed_pa - drained_pa > kPushes_pa) {
          found.push_back({series.stroke_m[at], drained_pa});
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

Estimate zero_of(const std::vector<Touch>& found, const Estimate& before) {
  if (found.empty()) {
    return before;
  }
  std::vector<double> values;
  for (const Touch& touch : found) {
    values.push_back(touch.drained_pa);
  }
  const double zero_pa = median(values);
  if (zero_pa > kMostZero_pa) {
    return before;  // Its draining side was not open.
  }
  return zero_pa > kNothing_pa ? Estimate{zero_pa, kPressureDeviation_pa, true}
                               : Estimate{kBelow_pa, kBelowDeviation_pa, false};
}

}  // namespace

void find_zeros(const std::vector<MachineLog>& logs, const ExcavatorProfile& profile,
                const std::vector<SteadyPoint>& points, MachineEstimate& machine) {
  for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
    DriveEstimate& drive = machine.drive[axis];
    const double most_m = profile.geometry.cylinder[axis].stroke_m;
    const std::vector<Touch> out =
        touches(logs, axis, true, most_m, least_open(points, axis, true));
    const std::vector<Touch> in = touches(logs, axis, false, 0.0, least_open(points, axis, false));
    drive.rod_zero_pa = zero_of(out, drive.rod_zero_pa);
    drive.cap_zero_pa = zero_of(in, drive.cap_zero_pa);
    if (!out.empty()) {
      drive.stroke_zero_m = {out.back().stroke_m - most_m, kStrokeDeviation_m, true};
    } else if (!in.empty() && in.back().stroke_m > kNoStroke_m) {
      drive.stroke_zero_m = {in.back().stroke_m, kStrokeDeviation_m, true};
    }
  }
}

}  // namespace graben::identify
