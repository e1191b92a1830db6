// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/limits/limits.hpp"

#include <algorithm>

#include "firmware/excavator/estimation/load/assumed_load.hpp"
#include "firmware/excavator/estimation/oil/tuning.hpp"
#include "firmware/excavator/limits/motion_cap.hpp"
#include "firmware/excavator/limits/tuning.hpp"
#include "firmware/excavator/swing.hpp"

namespace graben {
namespace {

void ease_blocked(const ExcavatorModel& machine, Span<const BlockedState> blocked, Motion& motion) {
  motion.towards_mps = motion.corrected_mps;
  motion.eases = any_eases(blocked);
  if (motion.eases) {
    // The oil of all drives gives way with the one that lets off, and would take the teeth along.
    // Once it is still nothing does; what would be corrected then moves the teeth across the path.
    const double still = (rested_s(blocked) - kEasedStillFrom_s) / kEasedStills_s;
    motion.corrected_mps = kEasedCorrects * (1.0 - std::clamp(still, 0.0, 1.0)) *
                           (motion.corrected_mps - motion.wanted_mps);
  }
  for (int i = 0; i < machine.drives.count(); ++i) {
    motion.corrected_mps[i] = eased_mps(blocked[i], motion.wanted_mps[i], motion.corrected_mps[i]);
  }
}

void hold_at_fences(const ExcavatorModel& machine, const InputState& inputs,
                    const EstimationState& estimates, double zero_m, const LastCycle& last,
                    Motion& motion) {
  const double coast_m =
      machine.profile.has_swing()
          ? swing_coast_m(inputs.accepted[kSwing].speed_mps, last.commands.asked_mps[kSwing])
          : 0.0;
  const MotionCap cap = motion_cap(machine.profile, machine.drives, machine.kinematics,
                                   motion.fences, strokes_then_m(machine.drives, estimates.servo),
                                   motion.corrected_mps, coast_m, zero_m);
  motion.cap = static_cast<const VelocityCap&>(cap);
  motion.wanted_mps = motion.wanted_mps.cwiseProduct(cap.share);
  motion.corrected_mps = motion.corrected_mps.cwiseProduct(cap.share);
}

void park_spools(const ExcavatorModel& machine, const ExcavatorValid& valid,
                 const EstimationState& estimates, double period_s, const LastCycle& last,
                 Motion& motion, LimitState& state) {
  const bool parks = is_by_field(valid.task) || motion.hand.assist == AssistState::kHolds;
  if (!parks || estimates.oil.weight < kOilLeads || motion.eases) {
    state.parking = {};
    return;
  }
  const double lambda = std::max(last.flow.lambda, machine.profile.control.servo_least_lambda);
  const double path_mps = valid.speed_override_ratio * machine.profile.dig_speed_mps;
  const double pace = std::min(1.0, path_mps / kParkingPath_mps);
  for (int axis = 0; axis < 2; ++axis) {
    if (park(motion.wanted_mps[axis], lambda * motion.corrected_mps[axis], pace, period_s,
             state.parking[static_cast<unsigned>(axis)])) {
      motion.corrected_mps[axis] = 0.0;
    }
  }
}

}  // namespace

McvInput valve_input(const ExcavatorModel& machine, const DriveVector& wanted_mps,
                     const ExcavatorValid& valid, const EstimationState& estimates) {
  const auto load = machine.profile.bus.pressures
                        ? estimates.load
                        : worst_loads(machine.profile, machine.drives, estimates.load, wanted_mps);
  return mcv_input(span_of(wanted_mps), load, valid.pump_flow_m3ps);
}

void hold_back(const ExcavatorModel& machine, const ExcavatorValid& valid, const InputState& inputs,
               const EstimationState& estimates, double period_s, const LastCycle& last,
               Motion& motion, LimitState& state) {
  ease_blocked(machine, inputs.watch.drives.blocked, motion);
  if (motion.fences.set == nullptr) {
    slow_at_ends(machine.drives, valid.drive, span_of(motion.corrected_mps), motion.cap);
  } else {
    const bool by_lever = is_by_lever(valid.task);
    hold_at_fences(machine, inputs, estimates, motion.zero_m, last, motion);
    if (by_lever && motion.cap.limit.kind == LimitKind::kNone) {
      motion.cap.limit = motion.hand.cap.limit;
    }
  }
  if (valid.external.stops()) {
    motion.cap.factor = 0.0;
  }
  park_spools(machine, valid, estimates, period_s, last, motion, state);
}

double reserve_ratio(const Motion& motion) {
  return motion.hand.assist == AssistState::kHolds ? kAssistReserve : 1.0;
}

Followed flow_limited(const ExcavatorModel& machine, const ExcavatorValid& valid,
                      const EstimationState& estimates, const Motion& motion, double period_s,
                      const LastCycle& last) {
  const ControlProfile& control = machine.profile.control;
  McvInput input = valve_input(machine, motion.wanted_mps, valid, estimates);
  const auto scale_to = [&](double factor, const DriveVector& velocity_mps) {
    for (unsigned i = 0; i < kDriveCount; ++i) {
      input.velocity_mps[i] = factor * velocity_mps[i];
    }
  };
  scale_to(motion.cap.factor, motion.wanted_mps);
  LambdaRise rise = control.lambda_rise;
  rise.reserve_n *= reserve_ratio(motion);
  Followed followed{
      steady_lambda(machine.valve, input, control.lambda_policy, rise, last.flow.lambda, period_s)};
  followed.lambda = followed.solution.point.lambda;
  const double of_path = followed.lambda;
  if (!machine.profile.bus.pressures) {
    // How fast, the worst load says; how far a spool opens for it, the likely one.
    input = mcv_input(span_of(motion.wanted_mps), estimates.load, valid.pump_flow_m3ps);
  }
  followed.eases = motion.eases;
  if (of_path > 0.0 || motion.eases) {
    const McvSolution of_wanted = followed.solution;
    const Limit path_limit = of_wanted.limit;
    input = opened_for(estimates.held, machine.drives, input);
    scale_to((motion.eases ? 1.0 : of_path) * motion.cap.factor, motion.corrected_mps);
    const double most =
        std::min(last.flow.of_corrected + control.lambda_rise.rate_ps * period_s, 1.0);
    LambdaRange range{most};
    range.taken = of_wanted.steps;
    followed.solution = solve_mcv(machine.valve, input, control.lambda_policy, range);
    followed.of_corrected = followed.solution.point.lambda;
    if (motion.task.moves && !motion.eases && followed.of_corrected < kMoveHeldUp) {
      followed.solution = of_wanted;
      followed.of_corrected = 1.0;
      followed.as_wanted = true;
    } else if (followed.of_corrected >= 1.0) {
      followed.solution.limit = path_limit;
    }
  }
  return followed;
}

}  // namespace graben
