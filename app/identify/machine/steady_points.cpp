// SPDX-License-Identifier: Apache-2.0
#include "app/identify/machine/steady_points.hpp"

#include <algorithm>
#include <cmath>

#include "app/identify/machine/clipped_pressure.hpp"
#include "firmware/excavator/excavator_profile.hpp"

namespace graben::identify {
namespace {

/// Half a window, in grid points: longer than half a period of the linkage on its oil would hide
/// what it does.
constexpr std::size_t kHalf = 8;
constexpr std::size_t kEvery = 4;
/// A spool has stood so long before: the oil has found its pressures.
constexpr std::size_t kSettles = 30;
/// Of the travel, within a window.
constexpr double kSpoolSteady = 0.04;
constexpr double kSpeedSteady_mps = 0.006;
constexpr double kSpeedSteady = 0.08;
/// A platform takes seconds to its speed, and its pressures say what pushes it meanwhile: its spool
/// may go on opening, and its angle is finer than a stroke.
constexpr double kSwingSpoolSteady = 0.12;
constexpr double kSwingNoise_mps = 0.0004;
/// Cushions begin here.
constexpr double kEnds_m = 0.06;
/// A spool nearer to its middle says nothing of its side.
constexpr double kAside = 0.04;
/// The stroke's resolution over a window, twice.
constexpr double kSpeedNoise_mps = 0.0015;
constexpr std::size_t kBlock = 400;

double mean(const std::vector<double>& values, std::size_t at) {
  double sum = 0.0;
  for (std::size_t k = at - kHalf; k <= at + kHalf; ++k) {
    sum += values[k];
  }
  return sum / (2.0 * kHalf + 1.0);
}

/// Slope of the straight line through a window.
double slope(const std::vector<double>& values, std::size_t at) {
  double sum = 0.0;
  double square = 0.0;
  for (std::size_t k = 1; k <= kHalf; ++k) {
    const auto n = static_cast<double>(k);
    sum += n * (values[at + k] - values[at - k]);
    square += 2.0 * n * n;
  }
  return sum / square / kGrid_s;
}

/// Change of the slope from the window's first half to its second.
double bend(const std::vector<double>& values, std::size_t at) {
  const double first = values[at] - values[at - kHalf];
  const double second = values[at + kHalf] - values[at];
  return (second - first) / (kGrid_s * static_cast<double>(kHalf));
}

/// Largest less least, from `before` points ago to the window's end.
double spread(const std::vector<double>& values, std::size_t at, std::size_t before) {
  const auto from = values.begin() + static_cast<std::ptrdiff_t>(at - before);
  const auto until = values.begin() + static_cast<std::ptrdiff_t>(at + kHalf + 1);
  const auto [least, most] = std::minmax_element(from, until);
  return *most - *least;
}

bool is_steady(const LogSegment& segment, std::size_t axis, std::size_t at, const DriveRow& drive) {
  const CylinderSeries& series = segment.axis[axis];
  const double stroke_m = series.stroke_m[at];
  if (stroke_m < drive.least_travel_m + kEnds_m || stroke_m > drive.most_travel_m - kEnds_m ||
      std::abs(series.spool[at]) < kAside || segment.engine_radps[at] <= 0.0) {
    return false;
  }
  for (std::size_t other = 0; other < segment.drives; ++other) {
    const double most = axis == kSwing && other == kSwing ? kSwingSpoolSteady : kSpoolSteady;
    if (spread(segment.axis[other].spool, at, kSettles) > most) {
      return false;
    }
  }
  const double speed_mps = std::abs(slope(series.stroke_m, at));
  return std::abs(bend(series.stroke_m, at)) < kSpeedSteady_mps + kSpeedSteady * speed_mps;
}

SteadyPoint point_of(const LogSegment& segment, const std::array<double, kDriveCount>& noise_pa,
                     std::size_t axis, std::size_t at) {
  SteadyPoint point;
  point.axis = static_cast<int>(axis);
  for (std::size_t k = 0; k < segment.drives; ++k) {
    const CylinderSeries& series = segment.axis[k];
    point.all_spool[k] = mean(series.spool, at);
    point.all_speed_mps[k] = slope(series.stroke_m, at);
    point.cap_pa[k] = unclipped_mean(mean(series.cap_pa, at), noise_pa[k]);
    point.rod_pa[k] = unclipped_mean(mean(series.rod_pa, at), noise_pa[k]);
  }
  for (std::size_t j = 0; j < kPumpCount; ++j) {
    point.swash[j] = mean(segment.swash[j], at);
  }
  point.engine_radps = mean(segment.engine_radps, at);
  point.spool = point.all_spool[axis];
  point.speed_mps = point.all_speed_mps[axis];
  point.stroke_m = segment.axis[axis].stroke_m[at];
  point.spool_rise_ps = slope(segment.axis[axis].spool, at);
  point.cap_rise_paps = slope(segment.axis[axis].cap_pa, at);
  point.rod_rise_paps = slope(segment.axis[axis].rod_pa, at);
  point.speed_spread_mps = (axis == kSwing ? kSwingNoise_mps : kSpeedNoise_mps) +
                           0.5 * std::abs(bend(segment.axis[axis].stroke_m, at));
  return point;
}

}  // namespace

std::vector<SteadyPoint> steady_points(const std::vector<MachineLog>& logs,
                                       const DriveModel& model) {
  std::vector<SteadyPoint> points;
  std::array<double, kDriveCount> noise_pa{};
  for (std::size_t axis = 0; axis < kDriveCount; ++axis) {
    noise_pa[axis] = pressure_noise_pa(logs, axis);
  }
  std::size_t block = 0;
  for (const MachineLog& log : logs) {
    for (const LogSegment& segment : log.segments) {
      for (std::size_t at = kSettles; at + kHalf < segment.size(); at += kEvery) {
        for (std::size_t axis = 0; axis < segment.drives; ++axis) {
          if (is_steady(segment, axis, at, model.drive[axis])) {
            points.push_back(point_of(segment, noise_pa, axis, at));
            points.back().block = block + at / kBlock;
          }
        }
      }
      block += segment.size() / kBlock + 1;
    }
  }
  return points;
}

}  // namespace graben::identify
