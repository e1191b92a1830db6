// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/dig/layer_pose.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/excavator/motion/dig/tuning.hpp"

namespace graben {
namespace {

static_assert(kLiftTries == kLiftUps.size() * kLiftTurns.size());

/// Mean speed of the turn on its way, of its most. [-; derived: kTurnFades]
constexpr double kTurnsMean = 1.0 - 0.5 * kTurnFades;

const LinePlan& line_of(const TaskProgram& program) {
  return program.step[static_cast<unsigned>(program.layers.step)].line;
}

double near_rad(const TeethPose& pose) {
  return std::atan2(pose.position_m.y(), pose.position_m.x());
}

bool is_reached(const SwingKinematics& kinematics, const TeethPose& pose) {
  return kinematics.drive_from_teeth(pose).blind.kind == BlindKind::kNone;
}

bool is_reached(const SwingKinematics& kinematics, const TeethLine& line) {
  constexpr int kLooks = 4;  ///< Poses that a line is looked at in. [-; size: of this loop]
  bool reached = true;
  for (int n = 1; n <= kLooks; ++n) {
    reached = reached && is_reached(kinematics, line.at(static_cast<double>(n) / kLooks));
  }
  return reached;
}

/// Of the design in the plane of the links: it rises outwards.
double incline_rad(const LayerPlan& plan, const TeethPose& at) {
  const Eigen::Vector2d outwards = at.position_m.head<2>().normalized();
  return std::atan2(-plan.up.head<2>().dot(outwards), plan.up.z());
}

TaskAim aim_of_cut(const SwingKinematics& kinematics, const TaskProgram& program,
                   const TaskState& state) {
  const TeethLine line = cut_line(program, state);
  TaskAim aim;
  aim.kind = StepKind::kDig;
  aim.share = state.dig.share;
  const Cut& cut = state.dug.cuts.cut;
  aim.teeth = cut_pose(program, cut, state.dig.share, state.dig.height_m + state.dug.zero_m);
  aim.straight = true;
  aim.cuts = true;
  aim.line = line;
  const double rate_ps = std::max(0.0, state.dig.rate_ps);
  TeethPose along = line.change;
  along.position_m *= rate_ps;
  along.attitude_rad =
      rate_ps * (line.change.attitude_rad +
                 steep_rad(program, cut) * steepness(program, cut, state.dig.share).rate_ps);
  const TeethPose rises = {
      state.dig.height_mps *
          turned(program.layers.up, strip_rad(program.layers, state.dug.cuts.cut.strip)),
      0.0};
  if (state.dig.height_mps < 0.0) {
    along.position_m += rises.position_m;
  }
  const DriveMotion motion =
      kinematics.motion_from_teeth(aim.teeth, along, {}, near_rad(aim.teeth));
  aim.blind = motion.blind;
  aim.value = motion.value;
  aim.velocity = motion.rate;
  if (state.dig.height_mps > 0.0) {
    aim.at_once = kinematics.motion_from_teeth(aim.teeth, rises, {}, near_rad(aim.teeth)).rate;
  }
  return aim;
}

TaskAim aim_of_lift(const SwingKinematics& kinematics, const TaskState& state) {
  const LinePlan& plan = state.dig.lift;
  const Progress progress = plan.ramp.at(state.time_s);
  const DriveMotion drives = line_motion(kinematics, plan.line, progress.share);
  TaskAim aim;
  aim.kind = StepKind::kDig;
  aim.blind = drives.blind;
  aim.share = 1.0;
  aim.value = drives.value;
  aim.velocity = progress.rate_ps * drives.rate;
  aim.teeth = plan.line.at(progress.share);
  return aim;
}

}  // namespace

bool at_cut(const TaskProgram& program, const TaskState& state) {
  return state.phase == TaskPhase::kSteps && state.step == program.layers.step;
}

double strip_rad(const LayerPlan& plan, int strip) {
  return plan.first_rad + strip * plan.strip_rad;
}

Eigen::Vector3d turned(const Eigen::Vector3d& at, double angle_rad) {
  const double c = std::cos(angle_rad);
  const double s = std::sin(angle_rad);
  return {c * at.x() - s * at.y(), s * at.x() + c * at.y(), at.z()};
}

double steep_rad(const TaskProgram& program, const Cut& cut) {
  return cut.steep *
         (program.layers.enter_rad - line_of(program).line.at(cut.from_share).attitude_rad);
}

Progress steepness(const TaskProgram& program, const Cut& cut, double share) {
  const double turns = program.layers.turns_m / program.layers.way_m;
  const double done = std::clamp((share - cut.from_share) / turns, 0.0, 1.0);
  const double left = 1.0 - done;
  if (left > kTurnFades) {
    return {1.0 - done / kTurnsMean, -1.0 / (kTurnsMean * turns), 0.0};
  }
  // A jump of the bucket's speed would be a dip of the edge.
  return {left * left / (2.0 * kTurnFades * kTurnsMean), -left / (kTurnFades * kTurnsMean * turns),
          0.0};
}

bool turns(const TaskProgram& program, const TaskState& state) {
  return (state.dig.share - state.dug.cuts.cut.from_share) * program.layers.way_m <
         program.layers.turns_m;
}

double most_rate_ps(const TaskProgram& program, const TaskState& state) {
  const LayerPlan& plan = program.layers;
  const Cut& cut = state.dug.cuts.cut;
  double most_mps = plan.speed_mps;
  if (cut.height_m <= 0.0) {
    most_mps = std::min(most_mps, kFinish_mps);
  }
  const double steep = std::abs(steep_rad(program, cut));
  const double turn_rad = steep * std::abs(steepness(program, cut, state.dig.share).rate_ps);
  if (turn_rad * most_mps > kCutTurn_radps * plan.way_m) {
    most_mps = kCutTurn_radps * plan.way_m / turn_rad;
  }
  return most_mps / plan.way_m;
}

TeethLine line_over(const TaskProgram& program, int strip, double height_m) {
  const TeethLine& line = line_of(program).line;
  const LayerPlan& plan = program.layers;
  const double angle_rad = strip_rad(plan, strip);
  TeethLine over = line;
  over.from.position_m = turned(line.from.position_m + height_m * plan.up, angle_rad);
  over.change.position_m = turned(line.change.position_m, angle_rad);
  return over;
}

TeethPose cut_pose(const TaskProgram& program, const Cut& cut, double share, double height_m) {
  TeethPose pose = line_over(program, std::max(0, cut.strip), height_m).at(share);
  pose.attitude_rad += steep_rad(program, cut) * steepness(program, cut, share).share;
  return pose;
}

TeethLine cut_line(const TaskProgram& program, const TaskState& state) {
  return line_over(program, std::max(0, state.dug.cuts.cut.strip),
                   state.dig.height_m + state.dug.zero_m);
}

namespace {

/// With its ramp, or without a way where the machine can't follow it.
LinePlan lift_along(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                    const TeethPose& from, const TeethPose& to) {
  LinePlan lift;
  lift.line = line_between(kinematics, from, to);
  if (!is_reached(kinematics, lift.line)) {
    lift.line = {from, {}};
    return lift;
  }
  lift.way_m = way_m(kinematics, lift.line);
  lift.ramp =
      ramp_for_speed(lift.way_m, kLiftSpeed_mps, kLiftShare * profile.line.acceleration_mps2);
  return lift;
}

}  // namespace

LinePlan lift_try(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                  const LayerPlan& plan, const TeethPose& from, LiftPart part, unsigned n) {
  const double out_m = plan.ground_z_m + kOutOfGround_share * plan.bucket_m - from.position_m.z();
  const bool folds = part == LiftPart::kFolds;
  const double up_m =
      folds ? kFoldUp_share * plan.bucket_m : std::max(kLiftLeast_share * plan.bucket_m, out_m);
  const double heel_free_rad =
      profile.geometry.body.floor_rad + incline_rad(plan, from) - kHeelFree_rad;
  const double to_rad = part == LiftPart::kFrees ? from.attitude_rad
                        : folds ? std::max({kFolded_rad, heel_free_rad, plan.carry_rad})
                                : plan.carry_rad;
  const double turn_rad = to_rad - from.attitude_rad;
  TeethPose to = from;
  to.position_m.z() += kLiftUps[n / kLiftTurns.size() % kLiftUps.size()] * up_m;
  to.attitude_rad += kLiftTurns[n % kLiftTurns.size()] * std::min(0.0, turn_rad);
  return lift_along(profile, kinematics, from, to);
}

LinePlan lift_line(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                   const LayerPlan& plan, const TeethPose& from, LiftPart part) {
  LinePlan lift;
  for (unsigned n = 0; n < kLiftTries && lift.way_m <= 0.0; ++n) {
    lift = lift_try(profile, kinematics, plan, from, part, n);
  }
  return lift;
}

LinePlan way_back(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                  const LayerPlan& plan, const TeethPose& from, const TeethPose& entered) {
  const Eigen::Vector3d off_m = entered.position_m - from.position_m;
  TeethPose to = entered;
  to.position_m.z() = from.position_m.z() + kLiftLeast_share * plan.bucket_m;
  if (off_m.head<2>().norm() > kSlot_share * plan.bucket_m) {
    return {{from, {}}, {}, 0.0};
  }
  return lift_along(profile, kinematics, from, to);
}

namespace {

bool begins_reached(const SwingKinematics& kinematics, const TaskProgram& program, const Cut& cut) {
  return is_reached(kinematics, cut_pose(program, cut, cut.from_share, cut.enters_m)) &&
         is_reached(kinematics, cut_pose(program, cut, cut.from_share, cut.height_m));
}

}  // namespace

double steepest(const SwingKinematics& kinematics, const TaskProgram& program, Cut cut) {
  for (const double steep : {1.0, 0.75, 0.5, 0.25}) {
    cut.steep = steep;
    if (begins_reached(kinematics, program, cut)) {
      return steep;
    }
  }
  return 0.0;
}

void begin_beyond(const SwingKinematics& kinematics, const TaskProgram& program, Cut& cut) {
  // Planning has not looked there: where something else than the design is fenced, it is let be.
  if (program.fences.count > 1) {
    return;
  }
  for (const double beyond : kBeyond_shares) {
    Cut farther = cut;
    farther.from_share = -beyond * program.layers.bucket_m / program.layers.way_m;
    for (const double steep : kSteepBeyond) {
      farther.steep = steep;
      if (begins_reached(kinematics, program, farther)) {
        cut = farther;
        return;
      }
    }
  }
}

TeethPose first_dig_pose(const SwingKinematics& kinematics, const TaskProgram& program) {
  Cut cut = undug(program.layers).cut;
  if (program.layers.touch_share >= 0.0) {
    return first_touch_pose(kinematics, program, cut.strip);
  }
  cut.steep = steepest(kinematics, program, cut);
  return cut_pose(program, cut, cut.from_share, cut.enters_m);
}

TaskAim layer_aim(const SwingKinematics& kinematics, const TaskProgram& program,
                  const TaskState& state) {
  if (at_cut(program, state)) {
    switch (state.dig.phase) {
      case CutPhase::kLifts:
        return aim_of_lift(kinematics, state);
      case CutPhase::kTouches:
        return aim_of_touch(kinematics, program, state);
      default:
        return aim_of_cut(kinematics, program, state);
    }
  }
  const TaskStep& step =
      program.step[static_cast<unsigned>(std::clamp(state.step, 0, kStepMost - 1))];
  return aim_of_plan(kinematics, step.kind, state.dig.move, state.time_s);
}

}  // namespace graben
