#include "firmware/excavator_controller.hpp"

#include <algorithm>

#include "firmware/motion/stroke_end.hpp"

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
Fault task_fault(const ValidInputs& valid) {
  return valid.task == Task::kNone || valid.task == Task::kDig ? Fault::kNone : Fault::kTaskUnknown;
}

/// What stands in the way beyond the inputs.
Fault motion_fault(const KinematicState& state, const McvSolution& solution) {
  if (state.status != ReachStatus::kOk) {
    return Fault::kPoseUnreachable;
  }
  const bool solved =
      solution.status == SolveStatus::kOk || solution.status == SolveStatus::kInfeasible;
  return solved ? Fault::kNone : Fault::kSolverFailed;
}

/// What holds the commanded speed: the valve before the stroke's end before the rise of lambda
/// before a lost sensor.
Limit reason(const McvSolution& solution, const VelocityCap& cap, const FaultSet& degraded) {
  if (solution.limit.kind != LimitKind::kNone) {
    return solution.limit;
  }
  if (cap.limit.kind != LimitKind::kNone) {
    return cap.limit;
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

void describe_motion(const DriveVector& wanted_mps, double path_error_m, const VelocityCap& cap,
                     const McvSolution& solution, const FaultSet& degraded,
                     ExcavatorStatus& status) {
  status.lambda = cap.factor * solution.point.lambda;
  status.limit = reason(solution, cap, degraded);
  status.path_error_m = path_error_m;
  for (unsigned i = 0; i < kDriveCount; ++i) {
    status.wanted_velocity_mps[i] = wanted_mps[i];
  }
  std::copy_n(solution.point.pump_pressure_pa.begin(), kPumpCount, status.pump_pressure_pa.begin());
}

}  // namespace

ExcavatorController::ExcavatorController(const ExcavatorProfile& profile)
    : profile_(profile),
      kinematics_(profile_.geometry),
      field_(profile_, kinematics_),
      valve_(mcv_machine(profile_)) {}

Fault ExcavatorController::memory_fault() const {
  return memory_.mode.intact() && memory_.lambda.intact() ? Fault::kNone : Fault::kMemoryCorrupt;
}

WatchResult ExcavatorController::judge(const ExcavatorInputs& inputs, double period_s,
                                       TimeUs now_us) {
  const ValidInputs valid =
      validate(inputs, profile_, memory_.validation, memory_.cycle.moving, now_us);
  memory_.validation = valid.state;
  WatchResult seen = watch(profile_, memory_.watch, memory_.cycle, valid, period_s);
  memory_.watch = seen.state;
  if (const Fault unknown = task_fault(valid); unknown != Fault::kNone) {
    FaultSet faults;
    faults.add(unknown);
    stop(faults, seen.inputs);
  }
  return seen;
}

void ExcavatorController::observe(const ValidInputs& valid, double period_s) {
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
  if (mode == EcuMode::kActive) {
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
  const KinematicState then = kinematics_.state(strokes_m.head<kAxisCount>());
  const KinematicState& there = then.status == ReachStatus::kOk ? then : state;
  DriveVector wanted_mps = DriveVector::Zero();
  wanted_mps.head<kAxisCount>() = field_.wanted(there, valid.speed_override_ratio);
  return wanted_mps;
}

DriveVector ExcavatorController::wanted_velocity(const ValidInputs& valid,
                                                 const KinematicState& state) const {
  const bool digs = valid.task == Task::kDig && state.status == ReachStatus::kOk;
  return digs ? dig_velocity(valid, state) : DriveVector::Zero();
}

ExcavatorOutputs ExcavatorController::step(const ExcavatorInputs& inputs, TimeUs now_us) {
  const CycleWatchResult time = watch_cycle(memory_.time, now_us);
  const Fault memory = memory_fault();
  const WatchResult seen = judge(inputs, time.period_s, now_us);
  const ValidInputs& valid = seen.inputs;
  observe(valid, time.elapsed_s);
  const KinematicState state = kinematics_.state(valid.strokes_m.head<kAxisCount>());
  const DriveVector wanted = wanted_velocity(valid, state);
  const double last_lambda = memory_.lambda.value();
  const DriveVector corrected =
      corrected_velocity(profile_, wanted, memory_.servo, last_lambda, valid.speed_override_ratio);
  const VelocityCap cap = stroke_end_cap(profile_, valid.strokes_m, corrected);
  const McvSolution solution = steady_lambda(
      valve_, mcv_input(seen, memory_.load, cap.factor * corrected), profile_.control.lambda_policy,
      profile_.control.lambda_rise, last_lambda, time.period_s);
  const ModeRequest request =
      mode_request(first_of({time.fault, memory, valid.fault, motion_fault(state, solution)}),
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
    describe_motion(wanted, path_error_m(field_.path(), state.tip), cap, solution, valid.degraded,
                    outputs.status);
    if (profile_.has_swing()) {
      outputs.status.swing_wanted_radps = wanted[kSwing] / profile_.swing.lever_m;
    }
  }
  memory_.mode = mode;
  memory_.gate = command.state;
  memory_.lambda = mode.mode == EcuMode::kActive ? solution.point.lambda : 0.0;
  memory_.cycle = {in_motion(mode.mode),
                   {command.enable, command.duty_ratio},
                   memory_.lambda.value() * cap.factor * corrected};
  memory_.expected_mps = memory_.lambda.value() * cap.factor * wanted;
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
