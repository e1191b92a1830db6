#pragma once
/// A move straight in drive space, from strokes and swing to strokes and swing: Zhang's joint space
/// method. It can't leave the box of strokes and swing that both its ends are in; what the teeth do
/// on the way is no line.

#include "firmware/excavator/tasks/line_plan.hpp"
#include "firmware/excavator/tasks/sine_ramp.hpp"

namespace graben {

/// How fast a move of the drives may be. Both hold: the longer of the two rules.
struct DrivePace {
  double limit_ratio = 1.0;  ///< Of the drives' limits of speed and acceleration, above 0, up to 1.
  double duration_s = 0.0;   ///< At least; 0: as short as the limits have it.
};

/// All that stays of a move. Evaluated where it is wanted, like a LinePlan.
struct DrivePlan {
  DriveVector from = DriveVector::Zero();    ///< Strokes m, swing rad.
  DriveVector change = DriveVector::Zero();  ///< To the move's end.
  SineRamp ramp;                             ///< Without duration where there is nothing to move.
};

/// A move at one moment.
struct DriveState {
  Progress progress;
  DriveVector value = DriveVector::Zero();
  DriveVector velocity = DriveVector::Zero();
  DriveVector acceleration = DriveVector::Zero();
};

/// All drives in proportion, by one sine ramp: the drive that needs longest sets the pace. Closed
/// form, cheap enough for a control cycle. `limits` all above 0.
[[nodiscard]] DrivePlan plan_drives(const DriveLimits& limits, const DriveVector& from,
                                    const DriveVector& to, const DrivePace& pace);

/// At a time from the start; before and after it stands at the ends.
[[nodiscard]] DriveState drive_state(const DrivePlan& plan, double time_s);

}  // namespace graben
