#include "firmware/safety/motion_watch.hpp"

#include <algorithm>
#include <cmath>

namespace graben {
namespace {

/// Until the oil has rung down after a spool has closed.
constexpr double kSettle_s = 0.5;
/// The anchor creeps after the stroke: leakage is no uncommanded motion.
constexpr double kForget_s = 10.0;
/// More than the sensor's resolution and its noise.
constexpr double kStill_m = 0.0005;

using Axis = MotionWatchState::Axis;

int direction_of(const ExcavatorProfile& profile, double spool_ratio) {
  const double edge = profile.valve.spool_to_duty.y_first();
  if (std::abs(spool_ratio) <= edge) {
    return 0;
  }
  return spool_ratio > 0.0 ? 1 : -1;
}

Axis followed(const Axis& last, int direction, double stroke_m, double period_s) {
  Axis axis = last;
  axis.direction = direction;
  axis.since_s = direction == last.direction ? last.since_s + period_s : 0.0;
  const bool settling = axis.since_s < kSettle_s;
  const bool leads = direction != 0 && direction * (stroke_m - axis.anchor_m) > 0.0;
  if (settling || leads) {
    axis.anchor_m = stroke_m;
  } else {
    axis.anchor_m += (stroke_m - axis.anchor_m) * std::min(1.0, period_s / kForget_s);
  }
  return axis;
}

void look_for_stillness(Axis& axis, double stroke_m, double asked_mps, double period_s) {
  if (std::abs(stroke_m - axis.still_m) > kStill_m) {
    axis.still_m = stroke_m;
    axis.unmoved_m = 0.0;
  } else if (axis.direction * asked_mps > 0.0) {
    axis.unmoved_m += std::abs(asked_mps) * period_s;
  }
}

}  // namespace

MotionWatchResult watch_motion(const ExcavatorProfile& profile, const MotionWatchState& last,
                               const ValidInputs& valid, const Eigen::Vector3d& asked_mps,
                               double period_s) {
  MotionWatchResult result;
  for (unsigned i = 0; i < kAxisCount; ++i) {
    const double stroke_m = valid.strokes_m[i];
    Axis axis =
        followed(last.axis[i], direction_of(profile, valid.spool_ratio[i]), stroke_m, period_s);
    look_for_stillness(axis, stroke_m, asked_mps[i], period_s);
    // Where its spool leads, the anchor has come along.
    if (std::abs(stroke_m - axis.anchor_m) > profile.safety.uncommanded_m) {
      result.faults.add(Fault::kUncommandedMotion);
    }
    if (axis.unmoved_m > profile.safety.stuck_m) {
      result.faults.add(Fault::kStrokeStuck);
    }
    result.state.axis[i] = axis;
  }
  return result;
}

}  // namespace graben
