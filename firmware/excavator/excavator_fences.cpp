/// Fences in the cycle: of the controller in excavator_controller.cpp.

#include "firmware/excavator/excavator_controller.hpp"
#include "firmware/excavator/swing.hpp"

namespace graben {

void ExcavatorController::hold_at_fences(const FenceSet& fences, Motion& motion) const {
  const double coast_m = profile_.has_swing() ? swing_coast_m(memory_.accepted[kSwing].speed_mps,
                                                              memory_.last.asked_mps[kSwing])
                                              : 0.0;
  const MotionCap cap =
      motion_cap(profile_, drives(), setup_.kinematics, fences,
                 strokes_then_m(drives(), memory_.servo), motion.corrected_mps, coast_m);
  motion.cap = static_cast<const VelocityCap&>(cap);
  motion.wanted_mps = motion.wanted_mps.cwiseProduct(cap.share);
  motion.corrected_mps = motion.corrected_mps.cwiseProduct(cap.share);
}

}  // namespace graben
