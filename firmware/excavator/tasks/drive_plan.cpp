#include "firmware/excavator/tasks/drive_plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace graben {
namespace {

/// Less of a change than this, m or rad, is rounding: none.
constexpr double kLeastChange = 1e-9;

}  // namespace

DrivePlan plan_drives(const DriveLimits& limits, const DriveVector& from, const DriveVector& to,
                      const DrivePace& pace) {
  DrivePlan plan{from, to - from, {}};
  if (!(plan.change.cwiseAbs().maxCoeff() > kLeastChange)) {
    return plan;
  }
  // In shares of the move: the whole way is 1.
  double speed_ps = std::numeric_limits<double>::max();
  double acceleration_ps2 = std::numeric_limits<double>::max();
  for (int i = 0; i < kDriveCount; ++i) {
    const double way = std::abs(plan.change[i]);
    if (way <= kLeastChange) {
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
