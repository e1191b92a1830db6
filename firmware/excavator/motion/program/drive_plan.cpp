// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/program/drive_plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "firmware/excavator/excavator_drives.hpp"
#include "firmware/excavator/motion/program/tuning.hpp"
#include "firmware/excavator/swing.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben {
namespace {

/// Square of the shortest time that a way takes: half of it faster, half slower.
double shortest_square_s2(double way_m, double acceleration_mps2) {
  return 2.0 * kPi * way_m / acceleration_mps2;
}

SineRamp short_trip(double way_m, double acceleration_mps2) {
  const double duration_s = std::sqrt(shortest_square_s2(way_m, acceleration_mps2));
  return {duration_s, 0.5 * duration_s};
}

/// First line of (7), by the time since the start.
Progress rising(const SineRamp& ramp, double time_s) {
  const double w = kPi / ramp.ramp_s;
  const double half_rate = 0.5 * ramp.peak_rate_ps();
  return {half_rate * (time_s - std::sin(w * time_s) / w), half_rate * (1.0 - std::cos(w * time_s)),
          half_rate * w * std::sin(w * time_s)};
}

}  // namespace

double SineRamp::most_rate_ps(double share) const {
  const double from_end = std::max(0.0, std::min(share, 1.0 - share));
  return std::min(peak_rate_ps(), std::sqrt(2.0 * peak_rate_change_ps2() * from_end));
}

double SineRamp::peak_rate_change_ps2() const { return 0.5 * kPi * peak_rate_ps() / ramp_s; }

Progress SineRamp::at(double time_s) const {
  const double left_s = duration_s - time_s;
  // Written so that NaN and a ramp without duration stay at the start.
  if (!(time_s > 0.0 && ramp_s > 0.0)) {
    return {};
  }
  if (left_s <= 0.0) {
    return {1.0, 0.0, 0.0};
  }
  if (time_s < ramp_s) {
    return rising(*this, time_s);
  }
  if (left_s < ramp_s) {
    // The third line of (7) is the first, run backwards from the end.
    const Progress mirror = rising(*this, left_s);
    return {1.0 - mirror.share, mirror.rate_ps, -mirror.rate_change_ps2};
  }
  return {peak_rate_ps() * (time_s - 0.5 * ramp_s), peak_rate_ps(), 0.0};
}

SineRamp ramp_for_duration(double way_m, double duration_s, double acceleration_mps2) {
  const double shortest_s2 = shortest_square_s2(way_m, acceleration_mps2);
  const double spare_s2 = duration_s * duration_s - shortest_s2;
  if (spare_s2 <= 0.0) {
    return short_trip(way_m, acceleration_mps2);
  }
  // The smaller root of way = 2 a / pi * t_1 (T - t_1), without the difference of near equals.
  return {duration_s, 0.5 * shortest_s2 / (duration_s + std::sqrt(spare_s2))};
}

SineRamp ramp_for_speed(double way_m, double speed_mps, double acceleration_mps2) {
  const double ramp_s = 0.5 * kPi * speed_mps / acceleration_mps2;
  if (speed_mps * ramp_s >= way_m) {
    return short_trip(way_m, acceleration_mps2);
  }
  return {way_m / speed_mps + ramp_s, ramp_s};
}

DriveLimits drive_limits(const ExcavatorProfile& profile) {
  DriveLimits limits;
  for (int i = 0; i < kAxisCount; ++i) {
    const CylinderGeometry& cylinder = profile.geometry.cylinder[static_cast<unsigned>(i)];
    const double flow_m3ps = most_flow_m3ps(profile, i);
    limits.speed_out[i] = flow_m3ps / cylinder.cap_area_m2();
    limits.speed_in[i] = flow_m3ps / cylinder.rod_area_m2();
    limits.acceleration[i] = profile.line.cylinder_acceleration_mps2[static_cast<unsigned>(i)];
  }
  const double swing_radps = swing_speed_max_radps(profile);
  limits.speed_out = with_swing(limits.speed_out, swing_radps);
  limits.speed_in = with_swing(limits.speed_in, swing_radps);
  limits.acceleration = with_swing(limits.acceleration, profile.swing.acceleration_max_radps2);
  return limits;
}

DrivePlan plan_drives(const DriveLimits& limits, const DriveVector& from, const DriveVector& to,
                      const DrivePace& pace) {
  DrivePlan plan{from, to - from, {}};
  if (!(plan.change.cwiseAbs().maxCoeff() > kDriveChangeLeast)) {
    return plan;
  }
  // In shares of the move: the whole way is 1.
  double speed_ps = std::numeric_limits<double>::max();
  double acceleration_ps2 = std::numeric_limits<double>::max();
  for (int i = 0; i < kDriveCount; ++i) {
    const double way = std::abs(plan.change[i]);
    if (way <= kDriveChangeLeast) {
      continue;
    }
    const double most = plan.change[i] > 0.0 ? limits.speed_out[i] : limits.speed_in[i];
    speed_ps = std::min(speed_ps, pace.limit_ratio * most / way);
    acceleration_ps2 = std::min(acceleration_ps2, pace.limit_ratio * limits.acceleration[i] / way);
  }
  plan.ramp = ramp_for_speed(1.0, speed_ps, acceleration_ps2);
  if (pace.duration_s > plan.ramp.duration_s) {
    // Of all ramps of that duration the slowest, so the limit of speed holds as well.
    plan.ramp = ramp_for_duration(1.0, pace.duration_s, acceleration_ps2);
  }
  return plan;
}

DriveState drive_state(const DrivePlan& plan, double time_s) {
  const Progress progress = plan.ramp.at(time_s);
  return {progress, plan.from + progress.share * plan.change, progress.rate_ps * plan.change,
          progress.rate_change_ps2 * plan.change};
}

}  // namespace graben
