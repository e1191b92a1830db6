// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <cmath>

#include "firmware/excavator/motion/dig/dig_phases.hpp"
#include "firmware/excavator/motion/dig/layer_pose.hpp"
#include "firmware/excavator/motion/dig/tuning.hpp"

namespace graben {
namespace {

double over_ground_m(const LayerPlan& plan) { return kTouchOver_share * plan.bucket_m; }

bool reaches(const SwingKinematics& kinematics, TeethPose pose, const LayerPlan& plan) {
  const double over_m = over_ground_m(plan);
  bool reached = true;
  for (const double height_m : {over_m, 0.5 * over_m, 0.0, -kTouchPlanDeepest_m}) {
    pose.position_m.z() = plan.ground_z_m + height_m;
    reached = reached && kinematics.drive_from_teeth(pose).blind.kind == BlindKind::kNone;
  }
  return reached;
}

TeethPose flat_pose(const SwingKinematics& kinematics, const TaskProgram& program, int strip,
                    double share) {
  TeethPose pose = line_over(program, strip, 0.0).at(share);
  pose.attitude_rad = kinematics.geometry().body.floor_rad;
  return pose;
}

/// Towards a speed, with bounded acceleration.
void change_speed(double wanted_mps, double period_s, DigRun& run) {
  const double by_mps = kTouchChange_mps2 * period_s;
  run.height_mps = std::clamp(wanted_mps, run.height_mps - by_mps, run.height_mps + by_mps);
}

}  // namespace

double touch_share(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                   const TaskProgram& program) {
  if (!profile.geometry.body.known()) {
    return -1.0;
  }
  for (const double share : {0.5, 0.35, 0.65, 0.2, 0.8, 0.05, 0.95}) {
    if (reaches(kinematics, flat_pose(kinematics, program, 0, share), program.layers)) {
      return share;
    }
  }
  return -1.0;
}

TeethPose touch_pose(const SwingKinematics& kinematics, const TaskProgram& program, int strip,
                     double height_m) {
  TeethPose pose = flat_pose(kinematics, program, std::max(0, strip), program.layers.touch_share);
  pose.position_m.z() = program.layers.ground_z_m + height_m;
  return pose;
}

TeethPose first_touch_pose(const SwingKinematics& kinematics, const TaskProgram& program,
                           int strip) {
  return touch_pose(kinematics, program, strip, over_ground_m(program.layers));
}

void TouchPhase::enter(const DigCycle& cycle, int /*step*/, TaskState& state) {
  DigRun& run = state.dig;
  run.height_m = over_ground_m(cycle.plan());
  run.height_mps = 0.0;
  run.give_m = 0.0;
  run.air_n = 0.0;
  run.up_n = 0.0;
}

bool TouchPhase::go_on(const DigCycle& cycle, TaskState& state) {
  DigRun& run = state.dig;
  const CutSeen& seen = cycle.seen;
  const double seen_m = seen.teeth.position_m.z() - cycle.plan().ground_z_m;
  if (state.dug.touched) {
    const double over_m = over_ground_m(cycle.plan());
    const double left_m = std::max(0.0, over_m - run.height_m);
    change_speed(std::min(kTouchRises_mps, std::sqrt(2.0 * kTouchChange_mps2 * left_m)),
                 cycle.period_s, run);
    run.height_m += std::max(0.0, run.height_mps) * cycle.advance_s;
    return run.height_m > over_m - 0.01;
  }
  const double over_m = std::max(0.0, run.height_m - kTouchSlowFrom_m);
  change_speed(-std::min(kTouchFalls_mps, std::sqrt(kTouchSlow_mps * kTouchSlow_mps +
                                                    2.0 * kTouchChange_mps2 * over_m)),
               cycle.period_s, run);
  run.height_m += state.pace_ratio * run.height_mps * cycle.advance_s;
  const double up_n = seen.force_known ? seen.force_n.y() : 0.0;
  if (seen_m > kTouchWeighed_m) {
    run.air_n += std::min(1.0, cycle.period_s / kTouchWeighs_s) * (up_n - run.air_n);
  }
  const bool is_near = run.height_m < kTouchSlowFrom_m;
  run.up_n += std::min(1.0, cycle.period_s / kTouchHeard_s) * (up_n - run.up_n);
  const double force_n = cycle.plan().force_n;
  const bool bears = is_near && seen.force_known && up_n - run.air_n > kTouchBears * force_n;
  const bool held = is_near && seen_m - run.height_m > kTouchHeldUp_m && seen.lambda > 0.0 &&
                    (!seen.force_known || run.up_n - run.air_n > kTouchBearsHeld * force_n);
  const bool found = bears || held;
  if (found || seen_m < -kTouchDeepest_m || run.height_m < -kTouchPlanDeepest_m) {
    state.dug.touched = true;
    state.dug.zero_m =
        found && std::abs(seen_m) <= kZeroMost_m ? seen_m * cycle.plan().up.z() : 0.0;
    run.height_m = seen_m;
    run.height_mps = 0.0;
  }
  return false;
}

void TouchPhase::leave(const DigCycle& cycle, TaskState& state) {
  enter_step(cycle, cycle.before_cut(), state);
}

TaskAim aim_of_touch(const SwingKinematics& kinematics, const TaskProgram& program,
                     const TaskState& state) {
  TaskAim aim;
  aim.kind = StepKind::kDig;
  aim.teeth = touch_pose(kinematics, program, state.dug.cuts.cut.strip, state.dig.height_m);
  const TeethPose along{{0.0, 0.0, state.dig.height_mps}, 0.0};
  const double near_rad = std::atan2(aim.teeth.position_m.y(), aim.teeth.position_m.x());
  const DriveMotion motion = kinematics.motion_from_teeth(aim.teeth, along, {}, near_rad);
  aim.blind = motion.blind;
  aim.value = motion.value;
  aim.velocity = motion.rate;
  return aim;
}

}  // namespace graben
