#include "firmware/excavator/excavator_controller.hpp"

#include <algorithm>

#include "firmware/drives/stroke_end.hpp"

namespace graben {
namespace {

McvInput mcv_input(const WatchResult& seen, const LoadState& load,
                   const DriveVector& velocity_mps) {
  McvInput input;
  for (unsigned i = 0; i < kDriveCount; ++i) {
    input.velocity_mps[i] = velocity_mps[i];
    input.cap_pressure_pa[i] = load.cap_pa[i];
    input.rod_pressure_pa[i] = load.rod_pa[i];
  }
  std::copy(seen.pump_flow_m3ps.begin(), seen.pump_flow_m3ps.end(), input.pump_flow_m3ps.begin());
  return input;
}

/// Whether the task that the operator asks for is one of ours.
Fault task_fault(const ValidInputs& valid, int program_count) {
  const bool known =
      valid.task == Task::kNone || valid.task == Task::kDig ||
      (valid.task == Task::kProgram && valid.task_number >= 0 && valid.task_number < program_count);
  return known ? Fault::kNone : Fault::kTaskUnknown;
}

/// What stands in the way beyond the inputs.
Fault motion_fault(const KinematicState& state, const TaskWant& task, const McvSolution& solution) {
  if (state.status != ReachStatus::kOk || !task.known) {
    return Fault::kPoseUnreachable;
  }
  const bool solved =
      solution.status == SolveStatus::kOk || solution.status == SolveStatus::kInfeasible;
  return solved ? Fault::kNone : Fault::kSolverFailed;
}

/// A plan that is followed at less than this share of its pace waits.
constexpr double kWaits = 0.5;

/// What holds the commanded speed: the valve before a soft limit before teeth that are behind their
/// plan before the rise of lambda before a lost sensor.
Limit reason(const McvSolution& solution, const VelocityCap& cap, const TaskWant& task,
             const FaultSet& degraded) {
  if (solution.limit.kind != LimitKind::kNone) {
    return solution.limit;
  }
  if (cap.limit.kind != LimitKind::kNone) {
    return cap.limit;
  }
  if (task.pace_ratio < kWaits) {
    return {LimitKind::kOffPath, 0};
  }
  if (solution.status == SolveStatus::kOk && solution.point.lambda < 1.0) {
    return {LimitKind::kRise, 0};
  }
  return degraded.empty()
             ? Limit{}
             : Limit{LimitKind::kDegraded, static_cast<std::uint8_t>(degraded.first())};
}

std::array<double, kDriveCount> drive_spools_m(const McvSolution& solution) {
  std::array<double, kDriveCount> spool_m{};
  std::copy_n(solution.point.spool_m.begin(), kDriveCount, spool_m.begin());
  return spool_m;
}

double path_error_m(const RoundedRectangle& path, const TipPose& tip) {
  const Eigen::Vector2d at(tip.x_m, tip.y_m);
  return (path.closest(at).position_m - at).norm();
}

}  // namespace

ExcavatorSetup::ExcavatorSetup(const ExcavatorProfile& machine, const TaskBook& tasks)
    : profile(machine),
      book(tasks),
      kinematics(profile.geometry),
      field(profile, kinematics.planar()),
      valve(mcv_machine(profile)) {}

ExcavatorController::ExcavatorController(const ExcavatorSetup& setup)
    : profile_(setup.profile),
      kinematics_(setup.kinematics),
      book_(setup.book),
      field_(setup.field),
      valve_(setup.valve) {}

Fault ExcavatorController::memory_fault() const {
  const bool intact = memory_.mode.intact() && memory_.lambda.intact() && memory_.task.intact();
  return intact ? Fault::kNone : Fault::kMemoryCorrupt;
}

WatchResult ExcavatorController::judge(const ExcavatorInputs& inputs, double period_s,
                                       TimeUs now_us) {
  const ValidInputs valid =
      validate(inputs, profile_, memory_.validation, memory_.cycle.moving, now_us);
  memory_.validation = valid.state;
  WatchResult seen = watch(profile_, memory_.watch, memory_.cycle, valid, period_s);
  if (const Fault unknown = task_fault(valid, book_.count); unknown != Fault::kNone) {
    FaultSet faults;
    faults.add(unknown);
    stop(faults, seen.inputs);
  }
  return seen;
}

void ExcavatorController::observe(const ValidInputs& valid, const TaskAim& aim, double period_s) {
  const EcuMode mode = memory_.mode.value().mode;
  LoadState measured = memory_.load;
  for (unsigned i = 0; i < kDriveCount; ++i) {
    if (valid.load_known[i]) {
      measured.cap_pa[i] = valid.cap_pressure_pa[i];
      measured.rod_pa[i] = valid.rod_pressure_pa[i];
    }
  }
  memory_.load = next_load(profile_.control.pressure_filter_s, memory_.load, measured, period_s,
                           mode != EcuMode::kActive);
  if (mode == EcuMode::kActive && aim.kind != StepKind::kNone) {
    memory_.servo = next_servo_on_plan(profile_, memory_.servo, memory_.expected_mps,
                                       valid.strokes_m, travel_of(profile_, aim.value),
                                       memory_.task.state.time_s == 0.0, period_s);
  } else if (mode == EcuMode::kActive) {
    memory_.servo = next_servo(profile_.control, memory_.servo, memory_.expected_mps,
                               valid.strokes_m, period_s);
  } else if (mode == EcuMode::kFault) {
    memory_.servo = servo_at_rest(valid.strokes_m);
  } else {
    memory_.servo = servo_released(profile_.control, memory_.servo, valid.strokes_m, period_s);
  }
}

DriveVector ExcavatorController::dig_velocity(const ValidInputs& valid,
                                              const KinematicState& state) const {
  const DriveVector strokes_m = strokes_then(profile_, memory_.servo);
  const KinematicState then = kinematics_.planar().state(strokes_m.head<kAxisCount>());
  const KinematicState& there = then.status == ReachStatus::kOk ? then : state;
  DriveVector wanted_mps = DriveVector::Zero();
  wanted_mps.head<kAxisCount>() = field_.wanted(there, valid.speed_override_ratio);
  return wanted_mps;
}

ExcavatorController::Motion ExcavatorController::dig_motion(const ValidInputs& valid,
                                                            const KinematicState& state) const {
  Motion motion;
  if (valid.task == Task::kDig && state.status == ReachStatus::kOk) {
    motion.wanted_mps = dig_velocity(valid, state);
  }
  motion.corrected_mps = corrected_velocity(profile_, motion.wanted_mps, memory_.servo,
                                            memory_.lambda.value(), valid.speed_override_ratio);
  motion.cap = stroke_end_cap(profile_, valid.strokes_m, motion.corrected_mps);
  motion.path_error_m = path_error_m(field_.path(), state.tip);
  return motion;
}

ExcavatorController::Motion ExcavatorController::task_motion(const TaskProgram& program,
                                                             const TaskAim& aim,
                                                             double speed_override_ratio,
                                                             double period_s) const {
  Motion motion;
  motion.task = want_of_task(profile_, kinematics_, program, memory_.task, aim, memory_.servo,
                             speed_override_ratio);
  motion.wanted_mps = motion.task.wanted_mps;
  motion.corrected_mps =
      corrected_velocity(profile_, motion.wanted_mps, memory_.servo, memory_.lambda.value(),
                         speed_override_ratio, motion.task.holds);
  motion.corrected_mps[kSwing] +=
      swing_lead_mps(profile_, motion.wanted_mps[kSwing], memory_.swing_wanted_mps, period_s);
  motion.cap = task_cap(profile_, kinematics_, program, memory_.servo, motion.corrected_mps);
  motion.path_error_m = motion.task.path_error_m;
  return motion;
}

const TaskProgram* ExcavatorController::running(const ValidInputs& valid) const {
  const TaskMemory& task = memory_.task;
  // A place that is not what was stored must not be looked up: it need not be in the program.
  const bool goes_on =
      task.runs && task.intact() && valid.task == Task::kProgram && task.number < book_.count;
  return goes_on ? &book_.program[task.number] : nullptr;
}

TaskMemory ExcavatorController::task_afterwards(const ValidInputs& valid, const Motion& motion,
                                                EcuMode mode, double lambda,
                                                double period_s) const {
  if (mode != EcuMode::kActive || valid.task != Task::kProgram) {
    return {};
  }
  const auto number = static_cast<std::uint8_t>(valid.task_number);
  const double followed = lambda * motion.cap.factor * valid.speed_override_ratio;
  return next_task(profile_, book_.program[number], memory_.task, number, valid.strokes_m, followed,
                   motion.task.error_m, period_s);
}

void ExcavatorController::describe_motion(const Motion& motion, const McvSolution& solution,
                                          const FaultSet& degraded, ExcavatorStatus& status) const {
  status.lambda = motion.cap.factor * solution.point.lambda;
  status.limit = reason(solution, motion.cap, motion.task, degraded);
  status.path_error_m = motion.path_error_m;
  for (unsigned i = 0; i < kDriveCount; ++i) {
    status.wanted_velocity_mps[i] = motion.wanted_mps[i];
  }
  status.swing_wanted_radps = drives_of(profile_, motion.wanted_mps)[kSwing];
  status.progress = motion.task.progress;
  std::copy_n(solution.point.pump_pressure_pa.begin(), kPumpCount, status.pump_pressure_pa.begin());
}

ExcavatorOutputs ExcavatorController::step(const ExcavatorInputs& inputs, TimeUs now_us) {
  const CycleWatchResult time = watch_cycle(memory_.time, now_us);
  const Fault memory = memory_fault();
  const WatchResult seen = judge(inputs, time.period_s, now_us);
  const ValidInputs& valid = seen.inputs;
  const TaskProgram* program = running(valid);
  const TaskAim aim =
      program != nullptr ? task_aim(kinematics_, *program, memory_.task.state) : TaskAim{};
  observe(valid, aim, time.elapsed_s);
  const KinematicState state = kinematics_.planar().state(valid.strokes_m.head<kAxisCount>());
  const Motion motion = program != nullptr
                            ? task_motion(*program, aim, valid.speed_override_ratio, time.period_s)
                            : dig_motion(valid, state);
  const McvSolution solution =
      steady_lambda(valve_, mcv_input(seen, memory_.load, motion.cap.factor * motion.corrected_mps),
                    profile_.control.lambda_policy, profile_.control.lambda_rise,
                    memory_.lambda.value(), time.period_s);
  const ModeRequest request = mode_request(
      first_of({time.fault, memory, valid.fault, motion_fault(state, motion.task, solution)}),
      valid, spools_centred(profile_, valid), inputs.link.stop_requested);
  ModeState mode = next_mode(stored_mode(memory_.mode), request);
  const GateResult command = gate(profile_, memory_.gate, mode.mode == EcuMode::kActive,
                                  drive_spools_m(solution), time.period_s);
  if (command.fault != Fault::kNone) {
    mode = {EcuMode::kFault, command.fault};
  }
  ExcavatorOutputs outputs;
  outputs.enable = command.enable;
  std::copy(command.duty_ratio.begin(), command.duty_ratio.end(), outputs.duty_ratio.begin());
  const PilotResult pressure = pilot(memory_.pilot, mode, valid.faults);
  outputs.pilot_cut = pressure.cut;
  outputs.pilot_known = pressure.state.known;
  outputs.swash_ratio = profile_.dig_swash_ratio;
  static_cast<MachineStatus&>(outputs.status) = describe(mode, request, valid);
  if (mode.mode == EcuMode::kActive) {
    describe_motion(motion, solution, valid.degraded, outputs.status);
  }
  memory_.mode = mode;
  memory_.gate = command.state;
  memory_.lambda = mode.mode == EcuMode::kActive ? solution.point.lambda : 0.0;
  memory_.cycle = {in_motion(mode.mode),
                   {command.enable, command.duty_ratio},
                   memory_.lambda.value() * motion.cap.factor * motion.corrected_mps};
  memory_.expected_mps = memory_.lambda.value() * motion.cap.factor * motion.wanted_mps;
  memory_.swing_wanted_mps = motion.task.wanted_mps[kSwing];
  memory_.task = task_afterwards(valid, motion, mode.mode, memory_.lambda.value(), time.period_s);
  memory_.pilot = pressure.state;
  memory_.time = time.state;
  return outputs;
}

ProfileCheck profile_check(const ExcavatorProfile& profile) {
  const ExcavatorKinematics kinematics(profile.geometry);
  const DigField field(profile, kinematics);
  return {check_machine(mcv_machine(profile)), field.reach(), field.unreached()};
}

}  // namespace graben
