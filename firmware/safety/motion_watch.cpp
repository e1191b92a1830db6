#include "firmware/safety/motion_watch.hpp"

namespace graben {

MotionWatchResult watch_motion(const ExcavatorProfile& profile, const MotionWatchState& last,
                               const ValidInputs& valid, const Eigen::Vector3d& asked_mps,
                               double period_s) {
  const CylinderLimits limits{profile.valve.spool_to_duty.y_first(), profile.safety.uncommanded_m,
                              profile.safety.stuck_m};
  MotionWatchResult result;
  for (unsigned i = 0; i < kAxisCount; ++i) {
    const CylinderWatchResult cylinder = watch_cylinder(
        limits, last.axis[i], {valid.strokes_m[i], valid.spool_ratio[i], asked_mps[i]}, period_s);
    result.state.axis[i] = cylinder.state;
    if (cylinder.uncommanded) {
      result.faults.add(Fault::kUncommandedMotion);
    }
    if (cylinder.stuck) {
      result.faults.add(Fault::kStrokeStuck);
    }
  }
  return result;
}

}  // namespace graben
