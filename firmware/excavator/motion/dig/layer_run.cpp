// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/dig/layer_run.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/excavator/motion/dig/cut_force.hpp"
#include "firmware/excavator/motion/dig/layer_height.hpp"
#include "firmware/excavator/motion/dig/layer_tare.hpp"
#include "firmware/excavator/motion/dig/layer_touch.hpp"
#include "firmware/excavator/swing.hpp"

namespace graben {
namespace {

/// What a heel stands on in a cut, pressed down, counts so much of what is before the edge.
constexpr double kBorne = 0.7;
/// Back down to the layer where it is light again.
constexpr double kReturns_mps = 0.05;
/// Down the foot of a wall that is cut back.
constexpr double kFootDown_mps = 0.25;
constexpr double kEasy = 0.7;
/// From here on a cut slows down, until it stands at kHoldsAt.
constexpr double kSlowsAt = 0.9;
/// A heavy cut that gets on by less, for so long, is ended; sooner at a wall.
constexpr double kGetsOn_mps = 0.01;
constexpr double kHeld_s = 1.0;
constexpr double kWallHeld_s = 0.6;
/// At a cut's end the teeth are waited for.
constexpr double kEndWait_s = 0.6;
constexpr double kEndNear_m = 0.02;
constexpr double kLiftNear_m = 0.10;
constexpr double kLiftHeld_s = 0.5;
/// Of the force that a cut may take, on a bucket that is folded.
constexpr double kHeelMost = 1.5;
/// A platform that swings about its place is waited for before it digs.
constexpr double kCutWaits_s = 10.0;
/// Of a move that leads to the next one.
constexpr double kPassed_m = 0.20;
/// Of ground as it mostly is.
constexpr double kGround_kgpm3 = 1750.0;
/// What springs by less is let be.
constexpr double kSpringFree_m = 0.018;
/// Of the force that a cut may take, at a wall.
constexpr double kWallPulls = 0.55;

DriveVector drives_now(const SwingKinematics& kinematics, const TaskProgram& program,
                       const TaskState& state) {
  return task_aim(kinematics, program, state).value;
}

/// A wall that breaks off lets the oil throw the teeth down: its force counts for more.
double counts(const LayerState& layers, double force) {
  return layers.share < 0.0 ? force / kWallPulls : force;
}

/// Steps of one program.
class LayerRun {
 public:
  LayerRun(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
           const TaskProgram& program, double advance_s, double period_s, const CutSeen& seen)
      : profile_(profile),
        kinematics_(kinematics),
        program_(program),
        plan_(program.layers),
        advance_s_(advance_s > 0.0 ? advance_s : 0.0),
        period_s_(period_s),
        seen_(seen) {}

  void begin(int step, TaskState& state) const;
  void go_on(TaskState& state) const;

 private:
  void begin_dig(TaskState& state) const;
  void begin_cut(TaskState& state) const;
  void begin_move(int step, TaskState& state) const;
  void begin_tare(int step, TarePart part, TaskState& state) const;
  void begin_lift(TaskState& state) const;
  void cut(TaskState& state) const;
  void lift(TaskState& state) const;
  void move(TaskState& state) const;
  void take(TaskState& state) const;
  [[nodiscard]] bool cut_ends(double heavy, TaskState& state) const;
  void next_step(TaskState& state) const;
  [[nodiscard]] bool lifts_next(const TaskState& state) const;

  const ExcavatorProfile& profile_;
  const SwingKinematics& kinematics_;
  const TaskProgram& program_;
  const LayerPlan& plan_;
  double advance_s_, period_s_;
  CutSeen seen_;
};

void LayerRun::begin(int step, TaskState& state) const {
  if (step == plan_.step) {
    begin_dig(state);
  } else if (tares_next(program_, step, state.layers)) {
    begin_tare(step, TarePart::kRaises, state);
  } else {
    begin_move(step, state);
    if (state.phase == TaskPhase::kSteps && (step + 1) % program_.step_count == plan_.step &&
        !(state.layers.move.ramp.duration_s > 0.0)) {
      step = (step + 1) % program_.step_count;
      begin_dig(state);
    }
  }
  state.step = step;
  state.time_s = 0.0;
  state.settle_s = 0.0;
  state.calm_s = 0.0;
}

void LayerRun::begin_dig(TaskState& state) const {
  if (touches_next(program_, state)) {
    begin_touch(state);
  } else {
    begin_cut(state);
  }
}

void LayerRun::begin_cut(TaskState& state) const {
  LayerState& layers = state.layers;
  const Cut& cut = layers.cuts.cut;
  layers.phase = CutPhase::kEnters;
  layers.share = cut.from_share;
  layers.seen_share = cut.from_share;
  layers.height_m = cut.enters_m;
  layers.height_mps = 0.0;
  layers.rate_ps = 0.0;
  layers.give_m = 0.0;
  layers.filled_m3 = 0.0;
  layers.cut_s = 0.0;
  layers.heavy_s = 0.0;
  layers.held_s = 0.0;
  layers.eases = false;
  layers.weighed_kg = 0.0;
}

void LayerRun::begin_tare(int step, TarePart part, TaskState& state) const {
  LayerState& layers = state.layers;
  layers.move = tare_move(profile_, program_.step[static_cast<unsigned>(step)], part,
                          drives_now(kinematics_, program_, state));
  layers.tares = part;
  layers.tared = true;
  state.time_s = 0.0;
  state.settle_s = 0.0;
  layers.phase = CutPhase::kNone;
}

/// To where the step leads; the last before the cut, to where the next cut begins.
void LayerRun::begin_move(int step, TaskState& state) const {
  const TaskStep& asked = program_.step[static_cast<unsigned>(step)];
  const DriveVector from = drives_now(kinematics_, program_, state);
  DriveVector to = asked.drives.from + asked.drives.change;
  if ((step + 1) % program_.step_count == plan_.step) {
    if (!state.layers.begun) {
      state.layers.cuts = undug(plan_);
      state.layers.begun = true;
    }
    weigh_cut(plan_, state.layers.weighed_kg / kGround_kgpm3, state.layers.cuts);
    if (state.layers.cuts.met) {
      state.phase = TaskPhase::kDone;
      state.layers.stands = from;
      return;
    }
    Cut& cut = state.layers.cuts.cut;
    cut.steep = steepest(kinematics_, program_, cut);
    if (state.layers.cuts.swept && state.layers.cuts.wall_falls) {
      begin_beyond(kinematics_, program_, cut);
    }
    const TeethPose enters =
        touches_next(program_, state)
            ? first_touch_pose(kinematics_, program_, cut.strip)
            : cut_pose(program_, cut, cut.from_share, cut.enters_m + state.layers.zero_m);
    const DriveResult drives = kinematics_.drive_from_teeth(enters);
    if (drives.blind.kind == BlindKind::kNone) {
      to = drives.value;
    }
  }
  state.layers.phase = CutPhase::kNone;
  state.layers.move =
      plan_drives(drive_limits(profile_), from, to, {asked.pace_ratio, asked.least_s});
}

void LayerRun::begin_lift(TaskState& state) const {
  LayerState& layers = state.layers;
  layers.folds = layers.phase == CutPhase::kCuts;
  // From where the teeth are: a plan that the soil has held off would first have to come back.
  const TeethPose from = layers.folds ? seen_.teeth : task_aim(kinematics_, program_, state).teeth;
  layers.lift = lift_line(profile_, kinematics_, plan_, from,
                          layers.folds ? LiftPart::kFolds : LiftPart::kOut);
  layers.phase = CutPhase::kLifts;
  layers.held_s = 0.0;
  state.time_s = 0.0;
  state.settle_s = 0.0;
}

void LayerRun::take(TaskState& state) const {
  LayerState& layers = state.layers;
  const TeethLine line = line_over(program_, layers.cuts.cut.strip, 0.0);
  const Eigen::Vector3d off_m = seen_.teeth.position_m - line.from.position_m;
  const double share = off_m.dot(line.change.position_m) / line.change.position_m.squaredNorm();
  if (share > layers.seen_share) {
    layers.filled_m3 +=
        pass(plan_, share, layers.seen_share, seen_height_m(program_, seen_, state), layers.cuts);
    layers.seen_share = share;
  }
}

bool LayerRun::cut_ends(double heavy, TaskState& state) const {
  LayerState& layers = state.layers;
  const double speed_mps = plan_.way_m * layers.rate_ps * state.pace_ratio;
  const bool held = heavy > 1.0 && speed_mps < kGetsOn_mps;
  const bool at_end = layers.share >= 1.0;
  layers.held_s = held || at_end ? layers.held_s + period_s_ : 0.0;
  const bool reached = at_end && (seen_.behind_m < kEndNear_m || layers.held_s > kEndWait_s);
  const double held_most_s = layers.share < 0.0 ? kWallHeld_s : kHeld_s;
  return reached || layers.held_s > held_most_s ||
         layers.cuts.loaded_m3 + layers.filled_m3 >=
             std::max(filling_m3(plan_, layers.cuts), layers.cuts.cut.volume_m3);
}

void LayerRun::cut(TaskState& state) const {
  LayerState& layers = state.layers;
  const TeethLine line = cut_line(program_, state);
  const double force = force_share(plan_, line, seen_, false);
  const double borne = kBorne * force_share(plan_, line, seen_, true);
  const double heavy = heaviness(counts(layers, std::max(force, borne)), seen_);
  if (!turns(program_, layers)) {
    layers.cut_s += period_s_;
    layers.heavy_s += heavy * period_s_;
  }
  const double change_m = heavy > 1.0     ? kGives_mps * std::min(1.0, 2.0 * (heavy - 1.0))
                          : heavy < kEasy ? -kReturns_mps
                                          : 0.0;
  const Cut& at = layers.cuts.cut;
  layers.give_m = std::clamp(layers.give_m + period_s_ * change_m, 0.0, at.enters_m - at.height_m);
  // What the oil gives back when the force goes must not lead through the design.
  const double gives_m =
      std::max(plan_.give_mpn * force * plan_.force_n, off_foot_m(plan_, at, seen_));
  const double springs_m = gives_m - kSpringFree_m - at.height_m;
  // Nor is soil that holds the teeth up pressed on by a plan that is farther below than this.
  const double held_up_m = seen_height_m(program_, seen_, state) - kBehind_m - at.height_m;
  rise({program_, kinematics_, advance_s_, period_s_},
       std::max(at.height_m + std::max({layers.give_m, springs_m, held_up_m}),
                wanted_height_m(program_, layers)),
       layers.share < 0.0 ? kFootDown_mps : kReturns_mps, state);
  const double most_ps = most_rate_ps(program_, layers) *
                         std::clamp((kHoldsAt - heavy) / (kHoldsAt - kSlowsAt), 0.0, 1.0);
  const double acceleration_ps2 = profile_.line.acceleration_mps2 / plan_.way_m;
  const double brakes_ps = std::sqrt(2.0 * acceleration_ps2 * std::max(0.0, 1.0 - layers.share));
  const double by_ps = acceleration_ps2 * period_s_;
  layers.rate_ps = std::clamp(std::min(most_ps, brakes_ps), layers.rate_ps - 4.0 * by_ps,
                              layers.rate_ps + by_ps);
  layers.share =
      std::min(1.0, layers.share + std::max(0.0, layers.rate_ps) * state.pace_ratio * advance_s_);
  if (1.0 - layers.share < 1e-4) {
    layers.share = 1.0;
    layers.rate_ps = 0.0;
  }
  take(state);
  if (cut_ends(heavy, state)) {
    begin_lift(state);
    next_cut(plan_,
             {layers.cut_s > 0.0 ? layers.heavy_s / layers.cut_s : kHoldsAt, layers.filled_m3,
              std::max(0.0, layers.share)},
             layers.cuts);
  }
}

void LayerRun::lift(TaskState& state) const {
  LayerState& layers = state.layers;
  // A heel that is turned against the ground stops nothing at first: valves and reliefs give way.
  const double bears =
      seen_.force_known && layers.folds ? seen_.force_n.norm() / (kHeelMost * plan_.force_n) : 0.0;
  layers.held_s = heaviness(bears, seen_) > 1.0 ? layers.held_s + period_s_ : 0.0;
  if (layers.held_s > kLiftHeld_s) {
    layers.lift = free_line(profile_, kinematics_, plan_, seen_.teeth, layers.entered);
    layers.folds = true;
    layers.held_s = 0.0;
    state.time_s = 0.0;
    state.settle_s = 0.0;
    return;
  }
  state.time_s += state.pace_ratio * advance_s_;
  const double end_s = state.layers.lift.ramp.duration_s;
  if (state.time_s < end_s) {
    return;
  }
  state.time_s = end_s;
  state.settle_s += period_s_;
  if (seen_.behind_m < kLiftNear_m || state.settle_s > kEndWait_s) {
    if (state.layers.folds && !lifts_next(state)) {
      begin_lift(state);
    } else {
      next_step(state);
    }
  }
}

void LayerRun::move(TaskState& state) const {
  if (program_.step[static_cast<unsigned>(state.step)].kind == StepKind::kSwing &&
      seen_.payload_known) {
    state.layers.weighed_kg = seen_.payload_kg;
  }
  state.time_s += state.pace_ratio * advance_s_;
  const double end_s = state.layers.move.ramp.duration_s;
  const bool tares = state.layers.tares != TarePart::kNone;
  state.settle_s += tares ? period_s_ : 0.0;
  if (state.settle_s > kTaresMost_s && tares) {
    next_step(state);
    return;
  }
  if (state.time_s < end_s) {
    return;
  }
  state.time_s = end_s;
  state.settle_s += period_s_;
  const bool digs_next = !tares && (state.step + 1) % program_.step_count == plan_.step;
  state.calm_s = seen_.behind_m < kMoveSettled_m ? state.calm_s + period_s_ : 0.0;
  const bool arrived = digs_next ? state.calm_s >= kCalm_s : seen_.behind_m < kPassed_m;
  if (arrived || state.settle_s >= (digs_next ? kCutWaits_s : kSettleMost_s)) {
    next_step(state);
  }
}

void LayerRun::next_step(TaskState& state) const {
  if (state.layers.tares == TarePart::kRaises) {
    begin_tare(state.step, TarePart::kReaches, state);
    return;
  }
  if (state.layers.tares != TarePart::kNone) {
    state.layers.tares = TarePart::kNone;
    begin(state.step, state);
    return;
  }
  if (state.step == plan_.step) {
    state.layers.cuts.loaded_m3 = 0.0;
  }
  begin((state.step + 1) % program_.step_count, state);
}

/// Nothing stands before a bucket at its line's end: the step that lifts it takes it out.
bool LayerRun::lifts_next(const TaskState& state) const {
  const int next = (state.step + 1) % program_.step_count;
  return state.layers.share >= 1.0 &&
         program_.step[static_cast<unsigned>(next)].kind == StepKind::kLift;
}

void LayerRun::go_on(TaskState& state) const {
  follow_pace(profile_.line, program_, seen_, period_s_, state);
  switch (state.layers.phase) {
    case CutPhase::kEnters:
      enter_on({program_, kinematics_, advance_s_, period_s_}, seen_, state);
      break;
    case CutPhase::kCuts:
      cut(state);
      break;
    case CutPhase::kLifts:
      lift(state);
      break;
    case CutPhase::kTouches:
      if (touch_on(program_, seen_, advance_s_, period_s_, state)) {
        begin((plan_.step + program_.step_count - 1) % program_.step_count, state);
      }
      break;
    default:
      move(state);
      break;
  }
}

}  // namespace

void layer_advance(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                   const TaskProgram& program, double advance_s, double period_s,
                   const CutSeen& seen, TaskState& state) {
  const LayerRun run(profile, kinematics, program, advance_s, period_s, seen);
  if (state.phase == TaskPhase::kApproach) {
    const int leg = state.step;
    state = task_advance(profile.line, program, state, advance_s, period_s, seen.behind_m);
    if (state.phase != TaskPhase::kApproach) {
      // By the move that leads to the cut: it may not be the first. It begins where the approach
      // ends.
      state.phase = TaskPhase::kApproach;
      state.step = leg;
      state.time_s = approach_leg(state.approach, program, leg).ramp.duration_s;
      run.begin((program.layers.step + program.step_count - 1) % program.step_count, state);
      state.phase = state.layers.cuts.met ? TaskPhase::kDone : TaskPhase::kSteps;
    }
  } else if (state.phase == TaskPhase::kSteps) {
    run.go_on(state);
  }
}

}  // namespace graben
