// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/excavator_controller.hpp"

#include <algorithm>

#include "firmware/excavator/estimation/load/assumed_load.hpp"
#include "firmware/excavator/swing.hpp"

namespace graben {
namespace {

/// It is laid around a path or a plan.
bool has_tube(Task task) {
  return task == Task::kDig || task == Task::kProgram || task == Task::kCoordinated;
}

bool is_by_lever(Task task) { return task == Task::kJog || task == Task::kCoordinated; }

/// kTaskUnknown unless the task that the operator asks for is there.
FaultSet task_faults(const ExcavatorValid& valid, int program_count) {
  const bool known =
      valid.task == Task::kNone || valid.task == Task::kDig || is_by_lever(valid.task) ||
      valid.task == Task::kCommission ||
      (valid.task == Task::kProgram && valid.task_number >= 0 && valid.task_number < program_count);
  FaultSet faults;
  faults.add(known ? Fault::kNone : Fault::kTaskUnknown);
  return faults;
}

/// Of the swing's correction, while it is to stand.
constexpr double kStandsShare = 0.5;

/// Of the path's speed, where a load has held a drive of late.
constexpr double kWary = 0.5;

/// A move goes on without corrections that leave less than this share of it: no line is off then,
/// and where a small correction needs more pressure than its pump has they never would be made.
constexpr double kHeldUp = 0.3;

/// A plan that is followed at less than this share of its pace waits.
constexpr double kWaits = 0.5;

/// What comes late is foretold over 20 ms, and shows no more of 10 Hz and beyond: with the feedback
/// of strokes one machine of twenty rings.
OilDesign oil_design(const ExcavatorProfile& profile) {
  OilDesign design;
  if (profile.foretells_joints()) {
    design.lag_s = 0.025;
    design.travel_ps = 4.0;
  }
  return design;
}

double path_error_m(const RoundedRectangle& path, const TipPose& tip) {
  const Eigen::Vector2d at(tip.x_m, tip.y_m);
  return (path.closest(at).position_m - at).norm();
}

}  // namespace

ExcavatorSetup::ExcavatorSetup(const ExcavatorProfile& machine, const TaskBook& tasks)
    : profile(machine),
      book(tasks),
      bank(excavator_bank(profile)),
      kinematics(profile.geometry),
      field(profile, kinematics.planar()),
      valve(mcv_machine(profile)),
      oil(profile.control.law == ControlLaw::kOil ? OilGains(oil_design(profile)) : OilGains()) {}

ExcavatorController::ExcavatorController(const ExcavatorSetup& setup)
    : setup_(setup), profile_(setup.profile) {}

ExcavatorOutputs ExcavatorController::step(const ExcavatorInputs& inputs, TimeUs now_us) {
  const Cycle cycle = begin_cycle(memory_.cycle, intact(), now_us);
  const ExcavatorValid valid = validate_and_watch(inputs, cycle, now_us);
  const Motion motion = next_motion(valid, cycle);
  const Followed followed = flow_limited(valid, motion, cycle.period_s);
  ModeDecision decision = decide_mode(
      memory_.cycle, cycle, valid, first_of({motion.fault, solver_fault(followed.solution)}),
      spools_centred(drives(), valid.drive) && valid.hands_rest(), inputs.link.stop_requested);
  ExcavatorOutputs outputs;
  const GateResult gated =
      gate(motion, decision.active(), followed.solution.point, cycle.period_s, outputs);
  take_refusal(gated.fault, decision);
  outputs.enable = gated.enable;
  if (!motion.tries) {
    open_as_learnt(outputs);
  }
  demand_pumps(valid, motion, decision.active(), cycle.period_s);
  outputs.swash_ratio = memory_.pumps.swash_ratio;
  end_cycle(decision, valid, memory_.cycle, outputs, outputs.status);
  if (decision.active()) {
    describe_motion(motion, followed, valid.degraded, outputs.status);
  }
  tell_learnt(outputs.status);
  outputs.status.tip_load = memory_.tip_load;
  outputs.status.joints = memory_.joints;
  remember(valid, motion, followed, decision, outputs, cycle.period_s);
  lead_spools(outputs);
  return outputs;
}

ExcavatorController::Motion ExcavatorController::next_motion(const ExcavatorValid& valid,
                                                             const Cycle& cycle) {
  const TaskProgram* program = running(valid);
  const TaskAim aim =
      program != nullptr ? task_aim(setup_.kinematics, *program, memory_.task.state) : TaskAim{};
  estimate(valid, aim, cycle);
  const KinematicState now = setup_.kinematics.planar().state(valid.strokes_m().head<kAxisCount>());
  if (!profile_.bus.pressures) {
    memory_.load = links_alone(profile_, now);
  }
  estimate_oil(valid, now, cycle.last_mode);
  estimate_load(valid, aim, now, cycle);
  Motion motion = wanted_motion(valid, now, program, aim, cycle.period_s);
  park_spools(valid, cycle.period_s, motion);
  return motion;
}

ExcavatorValid ExcavatorController::validate_and_watch(const ExcavatorInputs& inputs,
                                                       const Cycle& cycle, TimeUs now_us) {
  ExcavatorValid valid =
      profile_.imu.known() ? read_by_imus(inputs, cycle, now_us)
      : profile_.bus.joint_angles
          ? read_by_angles(inputs, now_us)
          : validate(profile_, drives(), inputs, memory_.last.moving, now_us, memory_.accepted);
  watch(profile_, drives(), memory_.last, memory_.pumps.swash_ratio, cycle.elapsed_s, memory_.watch,
        valid);
  stop(task_faults(valid, setup_.book.count), valid);
  if (any_blocked(memory_.watch.drives.blocked)) {
    warn(Fault::kBlocked, valid);
  }
  tell_stall(memory_.stall, profile_.safety.stall_s, valid);
  tell_tube(memory_.tube, valid);
  const DriveVector travel_m = valid.strokes_m();
  const TaskChoice task = task_after_change(
      memory_.change, {valid.task, valid.task_number}, memory_.last.moving,
      spools_centred(drives(), valid.drive), {travel_m.data(), drives().count()}, cycle.period_s);
  valid.task = task.task;
  valid.task_number = task.number;
  guard_commission(cycle, valid);
  return valid;
}

void ExcavatorController::estimate(const ExcavatorValid& valid, const TaskAim& aim,
                                   const Cycle& cycle) {
  const EcuMode mode = cycle.last_mode;
  const double elapsed_s = cycle.elapsed_s;
  next_loads(profile_.control.pressure_filter_s, valid.drive, elapsed_s, mode != EcuMode::kActive,
             memory_.load);
  next_swing_push(valid.drive[kSwing], elapsed_s, memory_.swing_push);
  const HandState& hand = memory_.hand;
  const bool on_plan = aim.kind != StepKind::kNone || hand.plans;
  const bool new_plan = hand.plans ? hand.is_new : memory_.task.state.time_s == 0.0;
  const DriveVector planned_m = hand.plans ? hand.planned_m : travel_of(profile_, aim.value);
  for (int i = 0; i < drives().count(); ++i) {
    const DriveRow& drive = drives()[i];
    ServoState& servo = memory_.servo.drive[static_cast<unsigned>(i)];
    const double stroke_m = valid.drive[static_cast<unsigned>(i)].stroke_m;
    const double expected_mps = memory_.expected_mps[i];
    const int blocked = memory_.watch.drives.blocked[static_cast<unsigned>(i)].side;
    if (mode == EcuMode::kActive && on_plan) {
      next_servo_on_plan(drive, expected_mps, stroke_m, planned_m[i], new_plan, elapsed_s, servo,
                         blocked);
    } else if (mode == EcuMode::kActive && memory_.jogs && expected_mps == 0.0) {
      release_servo(drive, stroke_m, elapsed_s, servo);
    } else {
      servo_after(drive, mode, expected_mps, stroke_m, elapsed_s, servo, blocked);
    }
  }
}

const TaskProgram* ExcavatorController::running(const ExcavatorValid& valid) const {
  const TaskMemory& task = memory_.task;
  // A place that is not what was stored must not be looked up: it need not be in the program.
  const bool goes_on =
      task.runs && task.intact() && valid.task == Task::kProgram && task.number < setup_.book.count;
  return goes_on ? &setup_.book.program[task.number] : nullptr;
}

ExcavatorController::Motion ExcavatorController::wanted_motion(const ExcavatorValid& valid,
                                                               const KinematicState& now,
                                                               const TaskProgram* program,
                                                               const TaskAim& aim,
                                                               double period_s) const {
  Motion motion;
  if (program != nullptr) {
    follow(*program, aim, valid.speed_override_ratio, period_s, motion);
  } else if (is_by_lever(valid.task)) {
    steer(valid, now, period_s, motion);
  } else {
    dig(valid, now, motion);
  }
  motion.tries = valid.task == Task::kCommission;
  const bool known = now.status == ReachStatus::kOk && motion.task.known;
  motion.fault = known ? Fault::kNone : Fault::kPoseUnreachable;
  if (known && memory_.task.search.failed) {
    motion.fault = Fault::kNoWay;
  }
  return motion;
}

DriveVector ExcavatorController::by_field(const KinematicState& now,
                                          double speed_override_ratio) const {
  DriveVector wanted_mps = DriveVector::Zero();
  DriveVector asked_m = DriveVector::Zero();
  Eigen::Vector3d field_mps = Eigen::Vector3d::Zero();
  for (int axis = 0; axis < kAxisCount; ++axis) {
    // Where the cylinders will be when a command of now to this one takes effect.
    const DriveVector when_m = strokes_when_m(drives(), memory_.servo, memory_.expected_mps, axis);
    if (axis == 0 || when_m != asked_m) {
      const KinematicState then = setup_.kinematics.planar().state(when_m.head<kAxisCount>());
      field_mps =
          setup_.field.wanted(then.status == ReachStatus::kOk ? then : now, speed_override_ratio);
      asked_m = when_m;
    }
    wanted_mps[axis] = field_mps[axis];
  }
  return wanted_mps;
}

void ExcavatorController::dig(const ExcavatorValid& valid, const KinematicState& now,
                              Motion& motion) const {
  if (valid.task == Task::kDig && now.status == ReachStatus::kOk) {
    motion.wanted_mps = by_field(now, valid.speed_override_ratio);
  }
  if (any_wary(memory_.watch.drives.blocked)) {
    motion.wanted_mps *= kWary;
  }
  motion.corrected_mps = corrected_velocity(drives(), motion.wanted_mps, memory_.servo,
                                            memory_.lambda.value(), valid.speed_override_ratio);
  correct_off_path(valid, now, motion);
  ease_blocked(motion);
  slow_at_ends(drives(), valid.drive, span_of(motion.corrected_mps), motion.cap);
  motion.path_error_m = path_error_m(setup_.field.path(), now.tip);
  // A task that looks for its way is on no path.
  motion.off_m = valid.task == Task::kDig ? motion.path_error_m : 0.0;
}

void ExcavatorController::follow(const TaskProgram& program, const TaskAim& aim,
                                 double speed_override_ratio, double period_s,
                                 Motion& motion) const {
  motion.task = want_of_task(profile_, drives(), setup_.kinematics, program, memory_.task, aim,
                             memory_.servo, speed_override_ratio);
  motion.wanted_mps = motion.task.wanted_mps;
  motion.corrected_mps =
      corrected_velocity(drives(), motion.wanted_mps, memory_.servo, memory_.lambda.value(),
                         speed_override_ratio, motion.task.holds);
  correct_off_plan(speed_override_ratio, motion);
  const double swing_mps = swing_of(motion.wanted_mps);
  if (swing_mps == 0.0) {
    // A platform that is to stand rings less on weaker corrections.
    motion.corrected_mps =
        with_swing(motion.corrected_mps, kStandsShare * swing_of(motion.corrected_mps));
  }
  motion.corrected_mps =
      with_swing(motion.corrected_mps,
                 swing_of(motion.corrected_mps) +
                     swing_lead_mps(profile_, swing_mps, memory_.swing_wanted_mps, period_s) +
                     swing_damping_mps(profile_, memory_.swing_push));
  ease_blocked(motion);
  hold_at_fences(program.fences, memory_.task.state.layers.zero_m, motion);
  motion.path_error_m = motion.task.path_error_m;
  motion.off_m = motion.task.off_m;
}

void ExcavatorController::ease_blocked(Motion& motion) const {
  motion.towards_mps = motion.corrected_mps;
  motion.eases = any_eases(memory_.watch.drives.blocked);
  if (motion.eases) {
    motion.corrected_mps.setZero();
  }
  for (int i = 0; i < drives().count(); ++i) {
    motion.corrected_mps[i] = eased_mps(memory_.watch.drives.blocked[static_cast<unsigned>(i)],
                                        motion.wanted_mps[i], motion.corrected_mps[i]);
  }
}

ExcavatorController::Followed ExcavatorController::flow_limited(const ExcavatorValid& valid,
                                                                const Motion& motion,
                                                                double period_s) const {
  const ControlProfile& control = profile_.control;
  McvInput input = input_for(motion.wanted_mps, valid);
  const auto scale_to = [&](double factor, const DriveVector& velocity_mps) {
    for (unsigned i = 0; i < kDriveCount; ++i) {
      input.velocity_mps[i] = factor * velocity_mps[i];
    }
  };
  scale_to(motion.cap.factor, motion.wanted_mps);
  Followed followed{steady_lambda(setup_.valve, input, control.lambda_policy, control.lambda_rise,
                                  memory_.lambda.value(), period_s)};
  followed.lambda = followed.solution.point.lambda;
  const double of_path = followed.lambda;
  if (!profile_.bus.pressures) {
    // How fast, the worst load says; how far a spool opens for it, the likely one.
    input = mcv_input(span_of(motion.wanted_mps), memory_.load, valid.pump_flow_m3ps);
  }
  followed.eases = motion.eases;
  if (of_path > 0.0 || motion.eases) {
    const McvSolution of_wanted = followed.solution;
    const Limit path_limit = of_wanted.limit;
    input = opened_for(memory_.held, drives(), input);
    scale_to((motion.eases ? 1.0 : of_path) * motion.cap.factor, motion.corrected_mps);
    const double most =
        std::min(memory_.of_corrected + control.lambda_rise.rate_ps * period_s, 1.0);
    followed.solution = solve_mcv(setup_.valve, input, control.lambda_policy, {most});
    followed.of_corrected = followed.solution.point.lambda;
    if (motion.task.moves && !motion.eases && followed.of_corrected < kHeldUp) {
      followed.solution = of_wanted;
      followed.of_corrected = 1.0;
      followed.as_wanted = true;
    } else if (followed.of_corrected >= 1.0) {
      followed.solution.limit = path_limit;
    }
  }
  return followed;
}

void ExcavatorController::describe_motion(const Motion& motion, const Followed& taken,
                                          const FaultSet& degraded, ExcavatorStatus& status) const {
  const McvSolution& solution = taken.solution;
  const bool waits = motion.task.pace_ratio < kWaits;
  const bool rises = !motion.tries && solution.status == SolveStatus::kOk && taken.of_way() < 1.0;
  status.lambda = motion.tries ? 1.0 : motion.cap.factor * motion.hand.cap.factor * taken.of_way();
  status.limit = held_by({blocked_limit(memory_.watch.drives.blocked),
                          solution.limit,
                          motion.tries ? commission_limit() : motion.cap.limit,
                          {waits ? LimitKind::kOffPath : LimitKind::kNone, 0},
                          {rises ? LimitKind::kRise : LimitKind::kNone, 0},
                          degraded_limit(degraded)});
  status.path_error_m = motion.path_error_m;
  std::copy_n(motion.wanted_mps.data(), kDriveCount, status.wanted_velocity_mps.begin());
  status.swing_wanted_radps = swing_of(drives_of(profile_, motion.wanted_mps));
  status.progress = motion.task.progress;
  std::copy_n(solution.point.pump_pressure_pa.begin(), kPumpCount, status.pump_pressure_pa.begin());
}

void ExcavatorController::remember(const ExcavatorValid& valid, const Motion& motion,
                                   const Followed& taken, const ModeDecision& decision,
                                   const ExcavatorOutputs& outputs, double period_s) {
  const McvPoint& point = taken.solution.point;
  const double followed = decision.active() ? taken.of_way() : 0.0;
  const double asked = decision.active() ? taken.all() : 0.0;
  const DriveVector asked_mps =
      asked * motion.cap.factor * (taken.as_wanted ? motion.wanted_mps : motion.corrected_mps);
  memory_.lambda = decision.active() ? taken.lambda : 0.0;
  memory_.of_corrected = decision.active() ? taken.of_corrected : 1.0;
  memory_.last = {in_motion(decision.mode.mode), outputs.enable, outputs.duty_ratio, {}, {}, {},
                  memory_.last.line_pa};
  memory_.last.tried = decision.active() && motion.tries;
  std::copy_n(asked_mps.data(), kDriveCount, memory_.last.asked_mps.begin());
  memory_.line_pa = point.pump_pressure_pa;
  memory_.held.yield_mpsn = {point.yield_mpsn[kBoom], point.yield_mpsn[kArm]};
  for (int i = 0; i < drives().count(); ++i) {
    const auto k = static_cast<unsigned>(i);
    const double line_pa =
        point.pump_pressure_pa[static_cast<unsigned>(setup_.valve.actuator[k].pump)];
    memory_.last.towards_mps[k] = motion.towards_mps[i];
    memory_.last.opening[k] = memory_.opening[k].value();
    if (point.lambda > 0.0) {
      memory_.last.line_pa[k] = line_pa;
    }
  }
  memory_.expected_mps = followed * motion.cap.factor * motion.wanted_mps;
  memory_.swing_wanted_mps = swing_of(motion.task.wanted_mps);
  const bool by_lever = decision.active() && is_by_lever(valid.task);
  memory_.jogs = by_lever && valid.task == Task::kJog;
  memory_.hand = by_lever ? next_by_hand(profile_.line, motion.hand, hand_ask(valid), memory_.hand,
                                         followed * motion.cap.factor, period_s)
                          : HandState{};
  next_tube(decision.active() && has_tube(valid.task), motion.off_m, profile_.safety.tube_m,
            memory_.tube);
  // A plan that waits for its drives asks for motion though it wants none now.
  const bool plans = motion.task.holds && !motion.task.bides && valid.speed_override_ratio > 0.0;
  const bool blocked = any_blocked(memory_.watch.drives.blocked);
  // A lever that is held against an end or a fence is no stall.
  const double allowed = by_lever ? 1.0 : motion.cap.factor;
  next_stall(decision.active(), plans || !motion.wanted_mps.isZero(),
             blocked || motion.task.astray ? 0.0 : followed * allowed * motion.task.pace_ratio,
             profile_.safety.stall_s, period_s, memory_.stall);
  if (!decision.active() || valid.task != Task::kProgram) {
    stop_task();
    return;
  }
  const auto number = static_cast<std::uint8_t>(valid.task_number);
  next_task(profile_, setup_.kinematics, setup_.book.program[number], number, valid.strokes_m(),
            followed * motion.cap.factor * valid.speed_override_ratio,
            {motion.task.teeth, motion.task.behind_m, followed * motion.cap.factor,
             memory_.tip_load.known, memory_.tip_load.force_n, memory_.tip_load.payload_known,
             memory_.tip_load.payload_kg},
            period_s, memory_.task);
}

ProfileCheck profile_check(const ExcavatorProfile& profile) {
  const ExcavatorKinematics kinematics(profile.geometry);
  const DigField field(profile, kinematics);
  return {check_machine(mcv_machine(profile)), field.reach(), field.unreached()};
}

}  // namespace graben
