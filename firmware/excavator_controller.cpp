#include "firmware/excavator_controller.hpp"

#include <algorithm>

#include "firmware/motion/stroke_end.hpp"

namespace graben {
namespace {

/// A stalled cycle must not turn into one large step of a rate limit.
constexpr double kLongestPeriod_s = 0.02;
/// Without a cycle for this long, what the machine did meanwhile is not known.
constexpr TimeUs kStalled_us = 50 * kMillisecondUs;

WantedMotion wanted_motion(const DigField& field, const KinematicState& state,
                           const ValidInputs& inputs) {
  return inputs.task == Task::kDig && state.status == ReachStatus::kOk
             ? field.wanted(state, inputs.speed_override_ratio)
             : WantedMotion{};
}

McvInput mcv_input(const ValidInputs& inputs, const Eigen::Vector3d& velocity_mps) {
  McvInput input;
  for (unsigned i = 0; i < kAxisCount; ++i) {
    input.velocity_mps[i] = velocity_mps[i];
    input.cap_pressure_pa[i] = inputs.cap_pressure_pa[i];
    input.rod_pressure_pa[i] = inputs.rod_pressure_pa[i];
  }
  std::copy(inputs.pump_flow_m3ps.begin(), inputs.pump_flow_m3ps.end(),
            input.pump_flow_m3ps.begin());
  return input;
}

/// A fault of this cycle beyond the inputs, as far as motion is asked for.
Fault blocking_fault(const ValidInputs& inputs, const KinematicState& state,
                     const McvSolution& solution, bool stalled) {
  if (stalled) {
    return Fault::kCycleStalled;
  }
  if (inputs.fault != Fault::kNone) {
    return inputs.fault;
  }
  if (state.status != ReachStatus::kOk) {
    return Fault::kPoseUnreachable;
  }
  const bool solved =
      solution.status == SolveStatus::kOk || solution.status == SolveStatus::kInfeasible;
  return solved ? Fault::kNone : Fault::kSolverFailed;
}

/// What holds the commanded speed: the valve before the stroke's end before the rise of lambda.
Limit reason(const McvSolution& solution, const VelocityCap& cap) {
  if (solution.limit.kind != LimitKind::kNone) {
    return solution.limit;
  }
  const bool rising = solution.status == SolveStatus::kOk && solution.point.lambda < 1.0;
  return cap.limit.kind == LimitKind::kNone && rising ? Limit{LimitKind::kRise, 0} : cap.limit;
}

ExcavatorStatus status_of(const ModeState& mode, const WantedMotion& wanted, const VelocityCap& cap,
                          const McvSolution& solution) {
  ExcavatorStatus status;
  status.mode = mode.mode;
  status.fault = mode.fault;
  if (mode.mode != EcuMode::kActive) {
    return status;
  }
  status.lambda = cap.factor * solution.point.lambda;
  status.limit = reason(solution, cap);
  status.path_error_m = wanted.path_error_m;
  for (unsigned i = 0; i < kAxisCount; ++i) {
    status.wanted_velocity_mps[i] = wanted.velocity_mps[i];
  }
  std::copy_n(solution.point.pump_pressure_pa.begin(), kPumpCount, status.pump_pressure_pa.begin());
  return status;
}

}  // namespace

ExcavatorController::ExcavatorController(const ExcavatorProfile& profile)
    : profile_(profile),
      kinematics_(profile_.geometry),
      field_(profile_, kinematics_),
      valve_(mcv_machine(profile_)) {}

double ExcavatorController::period_s(TimeUs now_us) const {
  if (!memory_.has_stepped) {
    return 0.0;
  }
  const double elapsed_s = static_cast<double>(now_us - memory_.last_us) * 1e-6;
  return std::clamp(elapsed_s, 0.0, kLongestPeriod_s);
}

ExcavatorOutputs ExcavatorController::step(const ExcavatorInputs& inputs, TimeUs now_us) {
  const ValidInputs valid = validate(inputs, profile_, now_us);
  const KinematicState state = kinematics_.state(valid.strokes_m);
  const WantedMotion wanted = wanted_motion(field_, state, valid);
  const VelocityCap cap = stroke_end_cap(profile_, valid.strokes_m, wanted.velocity_mps);
  const McvSolution solution = steady_lambda(
      valve_, mcv_input(valid, cap.factor * wanted.velocity_mps), profile_.control.lambda_policy,
      profile_.control.lambda_rise, memory_.lambda, period_s(now_us));
  const bool stalled = memory_.has_stepped && now_us - memory_.last_us > kStalled_us;
  memory_.mode = next_mode(memory_.mode, valid, blocking_fault(valid, state, solution, stalled));
  const GateResult command = gate(profile_, memory_.gate, memory_.mode.mode == EcuMode::kActive,
                                  {solution.point.spool_m[kBoom], solution.point.spool_m[kArm],
                                   solution.point.spool_m[kBucket]},
                                  period_s(now_us));
  if (command.fault != Fault::kNone) {
    memory_.mode = {EcuMode::kFault, command.fault};
  }
  memory_.gate = command.state;
  memory_.lambda = memory_.mode.mode == EcuMode::kActive ? solution.point.lambda : 0.0;
  memory_.last_us = now_us;
  memory_.has_stepped = true;
  return {command.enable, command.duty_ratio, status_of(memory_.mode, wanted, cap, solution)};
}

ProfileCheck profile_check(const ExcavatorProfile& profile) {
  const ExcavatorKinematics kinematics(profile.geometry);
  const DigField field(profile, kinematics);
  return {check_machine(mcv_machine(profile)), field.reach(), field.unreached()};
}

}  // namespace graben
