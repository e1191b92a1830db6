// SPDX-License-Identifier: Apache-2.0
/// Fences and levers in the cycle: of the controller in excavator_controller.cpp.

#include "firmware/excavator/excavator_controller.hpp"
#include "firmware/excavator/swing.hpp"

namespace graben {

void ExcavatorController::hold_at_fences(const FenceSet& fences, double zero_m,
                                         Motion& motion) const {
  const double coast_m = profile_.has_swing() ? swing_coast_m(memory_.accepted[kSwing].speed_mps,
                                                              memory_.last.asked_mps[kSwing])
                                              : 0.0;
  const MotionCap cap =
      motion_cap(profile_, drives(), setup_.kinematics, fences,
                 strokes_then_m(drives(), memory_.servo), motion.corrected_mps, coast_m, zero_m);
  motion.cap = static_cast<const VelocityCap&>(cap);
  motion.wanted_mps = motion.wanted_mps.cwiseProduct(cap.share);
  motion.corrected_mps = motion.corrected_mps.cwiseProduct(cap.share);
}

HandAsk ExcavatorController::hand_ask(const ExcavatorValid& valid) {
  return {valid.task, valid.lever_ratio, valid.speed_override_ratio};
}

void ExcavatorController::steer(const ExcavatorValid& valid, const KinematicState& now,
                                double period_s, Motion& motion) const {
  const bool jogs = valid.task == Task::kJog;
  motion.hand = want_by_hand(profile_, drives(), setup_.kinematics.planar(), now, memory_.servo,
                             hand_ask(valid), memory_.hand, period_s);
  motion.wanted_mps = motion.hand.wanted_mps;
  motion.task.pace_ratio = jogs ? 1.0 : memory_.hand.pace_ratio;
  motion.corrected_mps =
      corrected_velocity(drives(), motion.wanted_mps, memory_.servo, memory_.lambda.value(),
                         valid.speed_override_ratio, !jogs && motion.hand.moves);
  for (int i = 0; jogs && i < kDriveCount; ++i) {
    motion.corrected_mps[i] = motion.wanted_mps[i] == 0.0 ? 0.0 : motion.corrected_mps[i];
  }
  ease_blocked(motion);
  // Fences are those of the task that is chosen, or of the first.
  const bool chosen = valid.task_number >= 0 && valid.task_number < setup_.book.count;
  const FenceSet& fences =
      setup_.book.program[chosen ? static_cast<unsigned>(valid.task_number) : 0U].fences;
  hold_at_fences(fences, 0.0, motion);
  if (motion.cap.limit.kind == LimitKind::kNone) {
    motion.cap.limit = motion.hand.cap.limit;
  }
  motion.path_error_m = motion.hand.error_m;
  motion.off_m = motion.hand.error_m;
}

}  // namespace graben
