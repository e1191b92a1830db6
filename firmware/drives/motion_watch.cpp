// SPDX-License-Identifier: Apache-2.0
#include "firmware/drives/motion_watch.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/drives/tuning.hpp"

namespace graben {
namespace {

/// The duty up to which a spool is closed is where its table begins.
int direction_of(const DriveRow& drive, double spool_ratio) {
  if (std::abs(spool_ratio) <= drive.answer.towards(spool_ratio).edge()) {
    return 0;
  }
  return spool_ratio > 0.0 ? 1 : -1;
}

/// Where its dead band ends is known no better: beyond this the spool may lead its drive.
bool may_lead(const DriveRow& drive, double spool_ratio, double off_m) {
  const double edge = drive.answer.towards(spool_ratio).edge();
  return spool_ratio * off_m > 0.0 && std::abs(spool_ratio) > edge - kDirectionEdgeBand;
}

void follow(const DriveRow& drive, const ValidDrive& seen, double period_s, MotionState& motion) {
  const double stroke_m = seen.stroke_m;
  const int direction = direction_of(drive, seen.spool_ratio);
  motion.since_s = direction == motion.direction ? motion.since_s + period_s : 0.0;
  motion.direction = direction;
  const bool settling = motion.since_s < drive.watch.rest_s;
  if (settling || may_lead(drive, seen.spool_ratio, stroke_m - motion.anchor_m)) {
    motion.anchor_m = stroke_m;
  } else {
    motion.anchor_m += (stroke_m - motion.anchor_m) * std::min(1.0, period_s / kMotionForget_s);
  }
}

void look_for_stillness(double stroke_m, double asked_mps, double period_s, MotionState& motion) {
  if (std::abs(stroke_m - motion.still_m) > kMotionStill_m) {
    motion.still_m = stroke_m;
    motion.unmoved_m = 0.0;
  } else if (motion.direction * asked_mps > 0.0) {
    motion.unmoved_m += std::abs(asked_mps) * period_s;
  }
  motion.unmoved_m -= motion.unmoved_m * std::min(1.0, period_s / kMotionForget_s);
}

/// True: the sensor is wrong.
bool follow_pressure(const PressureBounds& bounds, double pressure_pa, double stroke_m,
                     double period_s, PressureState& sensor) {
  const double step_m = std::abs(stroke_m - sensor.stroke_m);
  if (pressure_pa != sensor.last_pa || pressure_pa <= bounds.empty_pa) {
    sensor.last_pa = pressure_pa;
    sensor.stroke_m = stroke_m;
    sensor.way_m = 0.0;
  } else if (step_m > kPressureStep_m) {
    sensor.stroke_m = stroke_m;
    sensor.way_m += step_m;
  }
  sensor.at_rail_s = pressure_pa >= bounds.rail_pa ? sensor.at_rail_s + period_s : 0.0;
  return sensor.at_rail_s > kPressureRail_s || sensor.way_m > kPressureStuck_m;
}

}  // namespace

FaultSet watch_motion(DriveRows drives, Span<const ValidDrive> seen, Span<const double> asked_mps,
                      double period_s, Span<MotionState> state) {
  FaultSet faults;
  for (int i = 0; i < drives.count(); ++i) {
    const DriveWatch& bounds = drives[i].watch;
    const double stroke_m = seen[i].stroke_m;
    MotionState& motion = state[i];
    follow(drives[i], seen[i], period_s, motion);
    look_for_stillness(stroke_m, asked_mps[i], period_s, motion);
    // Where its spool leads, the anchor has come along.
    if (std::abs(stroke_m - motion.anchor_m) > bounds.uncommanded_m) {
      faults.add(Fault::kUncommandedMotion);
    }
    if (motion.unmoved_m > bounds.stuck_m) {
      faults.add(Fault::kStrokeStuck);
    }
  }
  return faults;
}

bool watch_pressures(DriveRows drives, double empty_pa, Span<ValidDrive> seen, double period_s,
                     Span<PressurePair> state) {
  bool any_wrong = false;
  for (int i = 0; i < drives.count(); ++i) {
    ValidDrive& drive = seen[i];
    if (!drive.load_known) {
      continue;
    }
    const PressureBounds bounds = {empty_pa, drives[i].watch.pressure_rail_pa};
    const bool cap =
        follow_pressure(bounds, drive.cap_pressure_pa, drive.stroke_m, period_s, state[i][0]);
    const bool rod =
        follow_pressure(bounds, drive.rod_pressure_pa, drive.stroke_m, period_s, state[i][1]);
    drive.load_known = !cap && !rod;
    any_wrong = any_wrong || cap || rod;
  }
  return any_wrong;
}

}  // namespace graben
