#include "firmware/drives/cylinder_watch.hpp"

#include <algorithm>
#include <cmath>

namespace graben {
namespace {

/// The anchor creeps after the stroke: leakage is no uncommanded motion. Nor is a stroke stuck that
/// is asked, for minutes, for no more than leakage takes.
constexpr double kForget_s = 10.0;
/// More than the sensor's resolution and its noise.
constexpr double kStill_m = 0.0005;

int direction_of(double spool_edge, double spool_ratio) {
  if (std::abs(spool_ratio) <= spool_edge) {
    return 0;
  }
  return spool_ratio > 0.0 ? 1 : -1;
}

CylinderState followed(const CylinderLimits& limits, const CylinderState& last, int direction,
                       double stroke_m, double period_s) {
  CylinderState cylinder = last;
  cylinder.direction = direction;
  cylinder.since_s = direction == last.direction ? last.since_s + period_s : 0.0;
  const bool settling = cylinder.since_s < limits.settle_s;
  const bool leads = direction != 0 && direction * (stroke_m - cylinder.anchor_m) > 0.0;
  if (settling || leads) {
    cylinder.anchor_m = stroke_m;
  } else {
    cylinder.anchor_m += (stroke_m - cylinder.anchor_m) * std::min(1.0, period_s / kForget_s);
  }
  return cylinder;
}

void look_for_stillness(CylinderState& cylinder, double stroke_m, double asked_mps,
                        double period_s) {
  if (std::abs(stroke_m - cylinder.still_m) > kStill_m) {
    cylinder.still_m = stroke_m;
    cylinder.unmoved_m = 0.0;
  } else if (cylinder.direction * asked_mps > 0.0) {
    cylinder.unmoved_m += std::abs(asked_mps) * period_s;
  }
  cylinder.unmoved_m -= cylinder.unmoved_m * std::min(1.0, period_s / kForget_s);
}

}  // namespace

CylinderWatchResult watch_cylinder(const CylinderLimits& limits, const CylinderState& last,
                                   const CylinderSeen& seen, double period_s) {
  CylinderWatchResult result;
  CylinderState& cylinder = result.state;
  cylinder = followed(limits, last, direction_of(limits.spool_edge, seen.spool_ratio),
                      seen.stroke_m, period_s);
  look_for_stillness(cylinder, seen.stroke_m, seen.asked_mps, period_s);
  // Where its spool leads, the anchor has come along.
  result.uncommanded = std::abs(seen.stroke_m - cylinder.anchor_m) > limits.uncommanded_m;
  result.stuck = cylinder.unmoved_m > limits.stuck_m;
  return result;
}

}  // namespace graben
