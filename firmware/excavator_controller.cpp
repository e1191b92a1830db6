#include "firmware/excavator_controller.hpp"

#include <algorithm>

#include "firmware/motion/stroke_end.hpp"

namespace graben {
namespace {

/// A stalled cycle must not turn into one large step of a rate limit.
constexpr double kLongestPeriod_s = 0.02;
/// Without a cycle for this long, what the machine did meanwhile is not known.
constexpr TimeUs kStalled_us = 50 * kMillisecondUs;

McvInput mcv_input(const ValidInputs& inputs, const LoadState& load,
                   const Eigen::Vector3d& velocity_mps) {
  McvInput input;
  for (unsigned i = 0; i < kAxisCount; ++i) {
    input.velocity_mps[i] = velocity_mps[i];
    input.cap_pressure_pa[i] = load.cap_pa[i];
    input.rod_pressure_pa[i] = load.rod_pa[i];
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

double path_error_m(const RoundedRectangle& path, const TipPose& tip) {
  const Eigen::Vector2d at(tip.x_m, tip.y_m);
  return (path.closest(at).position_m - at).norm();
}

ExcavatorStatus status_of(const ModeState& mode, const Eigen::Vector3d& wanted_mps,
                          double path_error_m, const VelocityCap& cap,
                          const McvSolution& solution) {
  ExcavatorStatus status;
  status.mode = mode.mode;
  status.fault = mode.fault;
  if (mode.mode != EcuMode::kActive) {
    return status;
  }
  status.lambda = cap.factor * solution.point.lambda;
  status.limit = reason(solution, cap);
  status.path_error_m = path_error_m;
  for (unsigned i = 0; i < kAxisCount; ++i) {
    status.wanted_velocity_mps[i] = wanted_mps[i];
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

double ExcavatorController::elapsed_s(TimeUs now_us) const {
  const TimeUs elapsed_us = memory_.has_stepped ? now_us - memory_.last_us : 0;
  return static_cast<double>(std::clamp<TimeUs>(elapsed_us, 0, kStalled_us)) * 1e-6;
}

double ExcavatorController::period_s(TimeUs now_us) const {
  return std::min(elapsed_s(now_us), kLongestPeriod_s);
}

void ExcavatorController::observe(const ValidInputs& valid, double period_s) {
  const bool in_motion = memory_.mode.mode == EcuMode::kActive;
  memory_.load = next_load(profile_.control.pressure_filter_s, memory_.load,
                           {valid.cap_pressure_pa, valid.rod_pressure_pa}, period_s, !in_motion);
  if (in_motion) {
    memory_.servo =
        next_servo(profile_.control, memory_.servo, memory_.asked_mps, valid.strokes_m, period_s);
  } else if (memory_.mode.mode == EcuMode::kFault) {
    memory_.servo = servo_at_rest(valid.strokes_m);
  } else {
    memory_.servo = servo_released(profile_.control, memory_.servo, valid.strokes_m, period_s);
  }
}

Eigen::Vector3d ExcavatorController::wanted_velocity(const ValidInputs& valid,
                                                     const KinematicState& state) const {
  if (valid.task != Task::kDig || state.status != ReachStatus::kOk) {
    return Eigen::Vector3d::Zero();
  }
  const KinematicState then = kinematics_.state(strokes_then(profile_, memory_.servo));
  const KinematicState& there = then.status == ReachStatus::kOk ? then : state;
  return field_.wanted(there, valid.speed_override_ratio);
}

ExcavatorOutputs ExcavatorController::step(const ExcavatorInputs& inputs, TimeUs now_us) {
  const ValidInputs valid = validate(inputs, profile_, now_us);
  observe(valid, elapsed_s(now_us));
  const KinematicState state = kinematics_.state(valid.strokes_m);
  const Eigen::Vector3d wanted = wanted_velocity(valid, state);
  const Eigen::Vector3d corrected = corrected_velocity(profile_, wanted, memory_.servo,
                                                       memory_.lambda, valid.speed_override_ratio);
  const VelocityCap cap = stroke_end_cap(profile_, valid.strokes_m, corrected);
  const McvSolution solution =
      steady_lambda(valve_, mcv_input(valid, memory_.load, cap.factor * corrected),
                    profile_.control.lambda_policy, profile_.control.lambda_rise, memory_.lambda,
                    period_s(now_us));
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
  memory_.asked_mps = memory_.lambda * cap.factor * wanted;
  memory_.last_us = now_us;
  memory_.has_stepped = true;
  return {command.enable,
          false,
          command.duty_ratio,
          {},
          status_of(memory_.mode, wanted, path_error_m(field_.path(), state.tip), cap, solution)};
}

ProfileCheck profile_check(const ExcavatorProfile& profile) {
  const ExcavatorKinematics kinematics(profile.geometry);
  const DigField field(profile, kinematics);
  return {check_machine(mcv_machine(profile)), field.reach(), field.unreached()};
}

}  // namespace graben
