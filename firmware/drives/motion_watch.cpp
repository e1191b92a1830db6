#include "firmware/drives/motion_watch.hpp"

#include "firmware/drives/spool_follow.hpp"

namespace graben {
namespace {

CylinderLimits limits_of(const ExcavatorProfile& profile, int drive) {
  const double spool_edge = profile.valve.spool_to_duty.y_first();
  const SafetyProfile& safety = profile.safety;
  const double settle_s =
      kCylinderSettle_s + (profile.bus.spool_feedback
                               ? 0.0
                               : spool_arrives_s(profile.control.dead_time_s, safety.settle_s));
  if (drive != kSwing) {
    return {spool_edge, safety.uncommanded_m, safety.stuck_m, settle_s};
  }
  const SwingProfile& swing = profile.swing;
  // A platform at full speed goes on turning against its reliefs when its spool closes at once.
  const double stop_s = swing.speed_max_radps / swing.acceleration_max_radps2;
  return {spool_edge, safety.swing_uncommanded_rad * swing.lever_m,
          safety.swing_stuck_rad * swing.lever_m, settle_s + stop_s};
}

}  // namespace

MotionWatchResult watch_motion(const ExcavatorProfile& profile, const MotionWatchState& last,
                               const ValidInputs& valid, const DriveVector& asked_mps,
                               double period_s) {
  MotionWatchResult result;
  for (int drive = 0; drive < profile.drive_count; ++drive) {
    const auto i = static_cast<unsigned>(drive);
    const CylinderWatchResult cylinder =
        watch_cylinder(limits_of(profile, drive), last.drive[i],
                       {valid.strokes_m[drive], valid.spool_ratio[i], asked_mps[drive]}, period_s);
    result.state.drive[i] = cylinder.state;
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
