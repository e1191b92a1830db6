// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/dig/dig_phases.hpp"
#include "firmware/excavator/motion/dig/dig_run.hpp"
#include "firmware/excavator/motion/dig/layer_pose.hpp"
#include "firmware/excavator/motion/dig/tuning.hpp"

namespace graben {
namespace {

/// Place of teeth over the strip that they are nearest to.
struct OverStrip {
  double share = 0.0;     ///< Of its line.
  double height_m = 0.0;  ///< Over it.
  double aside_m = 0.0;   ///< From its middle.
};

OverStrip over_strip(const TaskProgram& program, double zero_m, const Eigen::Vector3d& teeth_m) {
  const LayerPlan& plan = program.layers;
  OverStrip nearest;
  for (int strip = 0; strip < plan.strips; ++strip) {
    const TeethLine line = line_over(program, strip, zero_m);
    const Eigen::Vector3d off_m = teeth_m - line.from.position_m;
    const Eigen::Vector3d& way_m = line.change.position_m;
    const double share = off_m.dot(way_m) / way_m.squaredNorm();
    const Eigen::Vector3d up = turned(plan.up, strip_rad(plan, strip));
    const double height_m = off_m.dot(up);
    const double aside_m = (off_m - share * way_m - height_m * up).norm();
    if (strip == 0 || aside_m < nearest.aside_m) {
      nearest = {share, height_m, aside_m};
    }
  }
  return nearest;
}

bool in_ground(const LayerPlan& plan, const OverStrip& at) {
  const double beyond = kResumesBeyond_share * plan.bucket_m / plan.way_m;
  return at.share > -beyond && at.share < 1.0 + beyond && at.aside_m < plan.width_m &&
         at.height_m < ground_m(plan, at.share) + kResumesOver_share * plan.bucket_m;
}

}  // namespace

DigResume way_to_resume(const SwingKinematics& kinematics, const TaskProgram& program,
                        const DriveVector& drives_now, TaskState& state) {
  DigResume way;
  if (!state.dug.begun) {
    return way;
  }
  way.teeth = kinematics.teeth_from_joints(kinematics.joints_from_drive(drives_now).value);
  const LayerPlan& plan = program.layers;
  const OverStrip at = over_strip(program, state.dug.zero_m, way.teeth.position_m);
  const double moved_m = (way.teeth.position_m - state.dug.teeth_m).norm();
  way.share = at.share;
  way.in_ground = in_ground(plan, at);
  way.can = way.in_ground || (state.dug.loaded && moved_m < kStillThere_share * plan.bucket_m);
  // Whoever has moved it has emptied it too.
  state.dug.loaded = state.dug.loaded && way.can;
  return way;
}

void dig_resume(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                const TaskProgram& program, const DriveVector& drives_now, const CutSeen& seen,
                const DigResume& way, TaskState& state) {
  // What is seen of the teeth is of a task that runs.
  CutSeen now = seen;
  now.teeth = way.teeth;
  const DigCycle cycle{profile, kinematics, program, 0.0, 0.0, now};
  const LayerPlan& plan = program.layers;
  TaskState next;
  next.dug = state.dug;
  if (way.in_ground) {
    next.phase = TaskPhase::kSteps;
    next.step = plan.step;
    next.dig.phase = CutPhase::kCuts;
    next.dig.share = way.share;
    next.dig.entered = now.teeth;
    abandon_cut(plan, next.dug.cuts);
    enter_phase<LiftPhase>(cycle, plan.step, next);
  } else {
    const bool lifts = state.dug.step == plan.step;
    next.phase = TaskPhase::kDone;
    next.stands = drives_now;
    enter_step(cycle, lifts ? cycle.after(plan.step) : state.dug.step, next);
    next.phase = TaskPhase::kSteps;
  }
  state = next;
}

}  // namespace graben
