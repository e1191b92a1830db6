#pragma once
/// Looks along a planned step for the first place where it leaves the swing's range or passes a
/// fence.

#include "firmware/excavator/tasks/task_program.hpp"

namespace graben {

/// The first place that is not left to the machine.
struct BarredPlace {
  ProgramRefusal why = ProgramRefusal::kNone;  ///< kNone: there is none.
  int fence = 0;
  MachinePoint point = MachinePoint::kTeeth;
  BlindPlace place;  ///< Its share to 1e-12; `blind` only where the points are not known.
};

/// A range or a fence may be passed by this much, m or rad: rounding of a pose that stands on it.
inline constexpr double kBarTolerance = 1e-6;

/// Drives of a step at this share of it, and their derivatives by the share.
[[nodiscard]] DriveMotion step_motion(const SwingKinematics& kinematics, const TaskStep& step,
                                      double share);

/// Walks a step that meets no blind spot in kWalkSteps steps, and looks between them wherever a
/// distance has its least there.
[[nodiscard]] BarredPlace first_barred_place(const ExcavatorProfile& profile,
                                             const SwingKinematics& kinematics,
                                             const FenceSet& fences, const TaskStep& step);

}  // namespace graben
