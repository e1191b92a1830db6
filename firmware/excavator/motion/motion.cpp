// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/motion.hpp"

#include <cmath>

#include "firmware/excavator/motion/on_oil.hpp"
#include "firmware/excavator/motion/tuning.hpp"
#include "firmware/excavator/swing.hpp"

namespace graben {
namespace {

double path_error_m(const RoundedRectangle& path, const TipPose& tip) {
  const Eigen::Vector2d at(tip.x_m, tip.y_m);
  return (path.closest(at).position_m - at).norm();
}

HandAsk hand_ask(const ExcavatorValid& valid) {
  return {
      valid.task, valid.lever_ratio, valid.speed_override_ratio, valid.external.speed_ratio, {}};
}

/// The program that is being followed and goes on to be asked for; null without one.
const TaskProgram* running(const TaskBook& book, const ExcavatorValid& valid,
                           const TaskMemory& task) {
  // A place that is not what was stored must not be looked up: it need not be in the program.
  const bool goes_on = task.runs && valid.task == Task::kProgram && task.number < book.count;
  return goes_on ? &book.program[task.number] : nullptr;
}

/// All that one cycle's motion is made of.
struct Known {
  const ExcavatorModel& machine;
  const MotionSources& sources;
  const ExcavatorValid& valid;
  const InputState& inputs;
  const EstimationState& estimates;
  double period_s;
  const LastCycle& last;
};

/// What the field wants of each cylinder at the place where its command of now takes effect.
DriveVector by_field(const Known& of) {
  const KinematicState& now = of.estimates.pose;
  DriveVector wanted_mps = DriveVector::Zero();
  DriveVector asked_m = DriveVector::Zero();
  Eigen::Vector3d field_mps = Eigen::Vector3d::Zero();
  for (int axis = 0; axis < kAxisCount; ++axis) {
    // Where the cylinders will be when a command of now to this one takes effect.
    const DriveVector when_m =
        strokes_when_m(of.machine.drives, of.estimates.servo, of.last.expected_mps, axis);
    if (axis == 0 || when_m != asked_m) {
      const KinematicState then = of.machine.kinematics.planar().state(when_m.head<kAxisCount>());
      field_mps = of.sources.field.wanted(then.status == ReachStatus::kOk ? then : now,
                                          of.valid.speed_override_ratio);
      asked_m = when_m;
    }
    wanted_mps[axis] = field_mps[axis];
  }
  return wanted_mps;
}

void dig(const Known& of, Motion& motion) {
  const ExcavatorValid& valid = of.valid;
  const KinematicState& now = of.estimates.pose;
  if (is_by_field(valid.task) && now.status == ReachStatus::kOk) {
    motion.wanted_mps = by_field(of);
  }
  if (any_wary(of.inputs.watch.drives.blocked)) {
    motion.wanted_mps *= kWaryPace;
  }
  const double lambda = of.last.flow.lambda;
  motion.corrected_mps = corrected_velocity(of.machine.drives, motion.wanted_mps,
                                            of.estimates.servo, lambda, valid.speed_override_ratio);
  correct_off_path(of.machine, of.sources, of.estimates, lambda, valid.speed_override_ratio,
                   motion);
  motion.path_error_m = path_error_m(of.sources.field.path(), now.tip);
  // A task that looks for its way is on no path.
  motion.off_m = is_by_field(valid.task) ? motion.path_error_m : 0.0;
}

void follow(const Known& of, const TaskProgram& program, const MotionMemory& state,
            Motion& motion) {
  const ExcavatorProfile& profile = of.machine.profile;
  const double lambda = of.last.flow.lambda;
  const double speed_override_ratio = of.valid.speed_override_ratio;
  motion.task = want_of_task(profile, of.machine.drives, of.machine.kinematics, program, state.task,
                             state.aim, of.estimates.servo, speed_override_ratio);
  motion.wanted_mps = motion.task.wanted_mps;
  motion.corrected_mps =
      corrected_velocity(of.machine.drives, motion.wanted_mps, of.estimates.servo, lambda,
                         speed_override_ratio, motion.task.holds);
  correct_off_plan(of.machine, of.sources, of.estimates, lambda, speed_override_ratio, motion);
  const double swing_mps = swing_of(motion.wanted_mps);
  if (swing_mps == 0.0) {
    // A platform that is to stand rings less on weaker corrections.
    motion.corrected_mps =
        with_swing(motion.corrected_mps, kSwingStandsShare * swing_of(motion.corrected_mps));
  }
  motion.corrected_mps =
      with_swing(motion.corrected_mps,
                 swing_of(motion.corrected_mps) +
                     swing_lead_mps(profile, swing_mps, of.last.swing_wanted_mps, of.period_s) +
                     swing_damping_mps(profile, of.estimates.swing_push));
  motion.fences = program.fences;
  motion.zero_m = state.task.state.dug.zero_m;
  motion.path_error_m = motion.task.path_error_m;
  motion.off_m = motion.task.off_m;
}

/// The chosen program's design where it lies by now, and by how much the last check at the mark has
/// shown heights over it too high.
void look_at_design(const Known& of, const HandState& hand, bool lost, HandAsk& ask,
                    Motion& motion) {
  const ExcavatorProfile& profile = of.machine.profile;
  const Eigen::Vector3d& off_m = of.last.mark.told.off_m;
  const Eigen::Vector2d shown_off_m(off_m.x(), off_m.z());
  const double swing_rad =
      profile.has_swing() ? of.estimates.servo.strokes_m()[kSwing] / profile.swing.lever_m : 0.0;
  AssistView view;
  view.now_m = of.estimates.pose.tip.x_m;
  view.at_m = hand.plans ? hand.tip.x_m : view.now_m;
  // Extending, the arm draws in.
  const double arm = ask.lever_ratio[kArm];
  view.way = arm > 0.0 ? -1.0 : arm < 0.0 ? 1.0 : 0.0;
  ask.design = assist_design(profile, motion.fences, swing_rad, shown_off_m, view);
  ask.design.lost = lost;
  motion.zero_m = ask.design.now.up.dot(shown_off_m);
}

/// By the levers.
void steer(const Known& of, const HandState& hand, Motion& motion) {
  const ExcavatorValid& valid = of.valid;
  const DriveRows& drives = of.machine.drives;
  // Fences are those of the task that is chosen, or of the first.
  const FenceSet& fences = of.sources.book.chosen(valid.task_number).fences;
  motion.fences = placed(fences, of.last.site);
  HandAsk ask = hand_ask(valid);
  if (valid.task == Task::kAssist) {
    ask.mode_radps = of.estimates.modes.omega_radps[0];
    look_at_design(of, hand, has_design(fences) && of.last.site.is_lost(), ask, motion);
  }
  const double lambda = of.last.flow.lambda;
  motion.hand = want_by_hand(of.machine.profile, drives, of.machine.kinematics.planar(),
                             of.estimates.pose, of.estimates.servo, ask, hand, of.period_s);
  const bool leads = motion.hand.leads;
  motion.wanted_mps = motion.hand.wanted_mps;
  motion.task.pace_ratio = leads ? hand.pace_ratio : 1.0;
  motion.corrected_mps = corrected_velocity(drives, motion.wanted_mps, of.estimates.servo, lambda,
                                            valid.speed_override_ratio, leads && motion.hand.moves);
  for (int i = 0; !leads && i < kDriveCount; ++i) {
    motion.corrected_mps[i] = motion.wanted_mps[i] == 0.0 ? 0.0 : motion.corrected_mps[i];
  }
  motion.path_error_m = motion.hand.error_m;
  motion.off_m = motion.hand.error_m;
  if (motion.hand.assist == AssistState::kHolds) {
    motion.zero_m -= kAssistFence_m;
    motion.task.holds = motion.hand.moves;
    motion.task.planned_m = motion.hand.planned_m;
    correct_off_plan(of.machine, of.sources, of.estimates, lambda, valid.speed_override_ratio,
                     motion);
    motion.path_error_m = std::abs(ask.design.now.height_m(of.estimates.pose.tip));
  }
}

/// Not inlined: what it makes would lie on the stack below the next search for a way.
[[gnu::noinline]] void stop_task(TaskMemory& task) { task = stopped(task); }

}  // namespace

MotionUnderWay motion_under_way(const ExcavatorModel& machine, const TaskBook& book,
                                const ExcavatorValid& valid, MotionMemory& state) {
  const TaskProgram* program = running(book, valid, state.task);
  state.aim =
      program != nullptr ? task_aim(machine.kinematics, *program, state.task.state) : TaskAim{};
  const HandState& hand = state.hand;
  MotionUnderWay motion;
  motion.kind = state.aim.kind;
  motion.share = state.aim.share;
  motion.on_plan = state.aim.kind != StepKind::kNone || hand.plans;
  motion.new_plan = hand.plans ? hand.is_new : state.task.state.time_s == 0.0;
  motion.planned_m = hand.plans ? hand.planned_m : travel_of(machine.profile, state.aim.value);
  motion.for_oil = is_by_field(valid.task) || state.aim.cuts || hand.assist == AssistState::kHolds;
  return motion;
}

Motion wanted_motion(const ExcavatorModel& machine, const MotionSources& sources,
                     const ExcavatorValid& valid, const InputState& inputs,
                     const EstimationState& estimates, double period_s, const LastCycle& last,
                     const MotionMemory& state) {
  const Known known = {machine, sources, valid, inputs, estimates, period_s, last};
  Motion motion;
  if (const TaskProgram* program = running(sources.book, valid, state.task)) {
    follow(known, *program, state, motion);
  } else if (is_by_lever(valid.task)) {
    steer(known, state.hand, motion);
  } else {
    dig(known, motion);
  }
  motion.tries = valid.task == Task::kCommission;
  const bool reached = estimates.pose.status == ReachStatus::kOk && motion.task.known;
  motion.fault = reached ? Fault::kNone : Fault::kPoseUnreachable;
  if (reached && state.task.search.failed) {
    motion.fault = Fault::kNoWay;
  }
  return motion;
}

void go_on(const ExcavatorModel& machine, const TaskBook& book, const ExcavatorValid& valid,
           const Motion& motion, const MotionFollowed& followed, const TipLoad& load,
           double period_s, MotionMemory& state) {
  const bool by_lever = followed.active && is_by_lever(valid.task);
  state.hand = by_lever ? next_by_hand(machine.profile.line, motion.hand, hand_ask(valid),
                                       state.hand, followed.share, period_s)
                        : HandState{};
  if (!followed.active || valid.task != Task::kProgram) {
    stop_task(state.task);
    return;
  }
  const auto number = static_cast<std::uint8_t>(valid.task_number);
  next_task(machine.profile, machine.kinematics, book.program[number], number, valid.strokes_m(),
            followed.share * valid.speed_override_ratio,
            {motion.task.teeth, motion.task.behind_m, followed.share, load.known, load.force_n,
             load.payload_known, load.payload_kg},
            period_s, state.task);
}

}  // namespace graben
