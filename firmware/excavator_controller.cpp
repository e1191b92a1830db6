#include "firmware/excavator_controller.hpp"

#include <algorithm>
#include <initializer_list>

#include "firmware/motion/stroke_end.hpp"
#include "firmware/safety/fault_table.hpp"

namespace graben {
namespace {

/// A stalled cycle must not turn into one large step of a rate limit.
constexpr double kLongestPeriod_s = 0.02;
/// Without a cycle for this long, what the machine did meanwhile is not known.
constexpr TimeUs kStalled_us = 50 * kMillisecondUs;
/// A cycle that comes later than this after the last one is an overrun.
constexpr TimeUs kLate_us = 15 * kMillisecondUs;

McvInput mcv_input(const WatchResult& seen, const LoadState& load,
                   const Eigen::Vector3d& velocity_mps) {
  McvInput input;
  for (unsigned i = 0; i < kAxisCount; ++i) {
    input.velocity_mps[i] = velocity_mps[i];
    input.cap_pressure_pa[i] = load.cap_pa[i];
    input.rod_pressure_pa[i] = load.rod_pa[i];
  }
  std::copy(seen.pump_flow_m3ps.begin(), seen.pump_flow_m3ps.end(), input.pump_flow_m3ps.begin());
  return input;
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

Fault first_of(std::initializer_list<Fault> faults) {
  const auto* there =
      std::find_if(faults.begin(), faults.end(), [](Fault fault) { return fault != Fault::kNone; });
  return there == faults.end() ? Fault::kNone : *there;
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

/// The mode that was stored; one that is not intact counts as stopped by that, whatever it has
/// become.
ModeState stored_mode(const Guarded<ModeState>& mode) {
  return mode.intact() ? mode.value() : ModeState{EcuMode::kFault, Fault::kMemoryCorrupt};
}

/// Whether the pilot pressure stays cut until the operator has armed again: a spool that did not
/// obey may not have it back because the deadman was let go.
bool keeps_pilot_cut(bool last, const ModeState& mode, const FaultSet& faults) {
  // Outside motion a spool is stuck only where it should have closed after it. Whatever stopped the
  // machine first must not hide it.
  const bool disobeyed =
      faults.has(Fault::kSpoolStuck) ||
      (mode.mode == EcuMode::kFault && (cuts_pilot(mode.fault) || cuts_pilot(faults)));
  return !in_motion(mode.mode) && (last || disobeyed);
}

double path_error_m(const RoundedRectangle& path, const TipPose& tip) {
  const Eigen::Vector2d at(tip.x_m, tip.y_m);
  return (path.closest(at).position_m - at).norm();
}

void describe_motion(const Eigen::Vector3d& wanted_mps, double path_error_m, const VelocityCap& cap,
                     const McvSolution& solution, const FaultSet& degraded,
                     ExcavatorStatus& status) {
  status.lambda = cap.factor * solution.point.lambda;
  status.limit = reason(solution, cap, degraded);
  status.path_error_m = path_error_m;
  for (unsigned i = 0; i < kAxisCount; ++i) {
    status.wanted_velocity_mps[i] = wanted_mps[i];
  }
  std::copy_n(solution.point.pump_pressure_pa.begin(), kPumpCount, status.pump_pressure_pa.begin());
}

/// What the operator reads of mode and faults.
ExcavatorStatus describe(const ModeState& mode, const ModeRequest& request,
                         const ValidInputs& valid) {
  ExcavatorStatus status;
  status.mode = mode.mode;
  status.faults = valid.faults;
  status.faults.add(request.fault);
  status.why_not_armed = why_not_armed(mode, request, status.faults);
  status.faults.add(mode.fault);
  status.fault = mode.fault != Fault::kNone ? mode.fault : valid.degraded.first();
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

Fault ExcavatorController::cycle_fault(TimeUs now_us) {
  const TimeUs elapsed_us = memory_.has_stepped ? now_us - memory_.last_us : 0;
  memory_.late_cycles = elapsed_us > kLate_us ? std::min(memory_.late_cycles + 1, 2) : 0;
  if (elapsed_us > kStalled_us) {
    return Fault::kCycleStalled;
  }
  if (memory_.late_cycles >= 2) {
    return Fault::kCycleOverrun;
  }
  return memory_.mode.intact() && memory_.lambda.intact() ? Fault::kNone : Fault::kMemoryCorrupt;
}

WatchResult ExcavatorController::judge(const ExcavatorInputs& inputs, TimeUs now_us) {
  const ValidInputs valid =
      validate(inputs, profile_, memory_.validation, memory_.cycle.moving, now_us);
  memory_.validation = valid.state;
  const WatchResult seen = watch(profile_, memory_.watch, memory_.cycle, valid, period_s(now_us));
  memory_.watch = seen.state;
  return seen;
}

void ExcavatorController::observe(const ValidInputs& valid, double period_s) {
  const EcuMode mode = memory_.mode.value().mode;
  LoadState measured = memory_.load;
  for (unsigned i = 0; i < kAxisCount; ++i) {
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
  const Fault timing = cycle_fault(now_us);
  const WatchResult seen = judge(inputs, now_us);
  const ValidInputs& valid = seen.inputs;
  observe(valid, elapsed_s(now_us));
  const KinematicState state = kinematics_.state(valid.strokes_m);
  const Eigen::Vector3d wanted = wanted_velocity(valid, state);
  const double last_lambda = memory_.lambda.value();
  const Eigen::Vector3d corrected =
      corrected_velocity(profile_, wanted, memory_.servo, last_lambda, valid.speed_override_ratio);
  const VelocityCap cap = stroke_end_cap(profile_, valid.strokes_m, corrected);
  const McvSolution solution = steady_lambda(
      valve_, mcv_input(seen, memory_.load, cap.factor * corrected), profile_.control.lambda_policy,
      profile_.control.lambda_rise, last_lambda, period_s(now_us));
  const ModeRequest request{first_of({timing, valid.fault, motion_fault(state, solution)}),
                            valid.enable,
                            valid.automatic,
                            valid.task != Task::kNone,
                            spools_centred(profile_, valid),
                            inputs.link.stop_requested};
  ModeState mode = next_mode(stored_mode(memory_.mode), request);
  const GateResult command = gate(profile_, memory_.gate, mode.mode == EcuMode::kActive,
                                  {solution.point.spool_m[kBoom], solution.point.spool_m[kArm],
                                   solution.point.spool_m[kBucket]},
                                  period_s(now_us));
  if (command.fault != Fault::kNone) {
    mode = {EcuMode::kFault, command.fault};
  }
  ExcavatorOutputs outputs;
  outputs.enable = command.enable;
  outputs.duty_ratio = command.duty_ratio;
  memory_.pilot_cut = keeps_pilot_cut(memory_.pilot_cut, mode, valid.faults);
  outputs.pilot_cut = memory_.pilot_cut || cuts_pilot(mode.fault) || cuts_pilot(valid.faults);
  memory_.pilot_known = memory_.pilot_known || in_motion(mode.mode) || outputs.pilot_cut;
  outputs.pilot_known = memory_.pilot_known;
  outputs.swash_ratio = profile_.dig_swash_ratio;
  outputs.status = describe(mode, request, valid);
  if (mode.mode == EcuMode::kActive) {
    describe_motion(wanted, path_error_m(field_.path(), state.tip), cap, solution, valid.degraded,
                    outputs.status);
  }
  memory_.mode = mode;
  memory_.gate = command.state;
  memory_.lambda = mode.mode == EcuMode::kActive ? solution.point.lambda : 0.0;
  memory_.cycle = {in_motion(mode.mode),
                   {command.enable, command.duty_ratio},
                   memory_.lambda.value() * cap.factor * corrected};
  memory_.expected_mps = memory_.lambda.value() * cap.factor * wanted;
  memory_.last_us = now_us;
  memory_.has_stepped = true;
  return outputs;
}

ProfileCheck profile_check(const ExcavatorProfile& profile) {
  const ExcavatorKinematics kinematics(profile.geometry);
  const DigField field(profile, kinematics);
  return {check_machine(mcv_machine(profile)), field.reach(), field.unreached()};
}

}  // namespace graben
