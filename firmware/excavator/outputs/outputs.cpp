// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/outputs/outputs.hpp"

namespace graben {
namespace {

/// Time constant of the side to which a spool is to go, that is led through; 0 of one that is too
/// slow for it.
double led_through_s(const SpoolAnswers& answer, double wanted_ratio, double travel_ratio) {
  const bool extends = wanted_ratio != 0.0 ? wanted_ratio > 0.0 : travel_ratio > 0.0;
  const double constant_s = answer.side(extends).spool_time_constant_s;
  return constant_s <= kLedSpoolMost_s ? constant_s : 0.0;
}

/// Duties for the valves as they turned out to be.
void open_as_learnt(const ExcavatorModel& machine, const InputState& inputs,
                    const LimitState& limits, const OutputState& state, ExcavatorOutputs& outputs) {
  if (machine.profile.control.law == ControlLaw::kKim || !outputs.enable) {
    return;
  }
  const auto& learnt = inputs.watch.drives.learnt;
  for (int i = 0; i < machine.drives.count(); ++i) {
    const auto k = static_cast<unsigned>(i);
    const DriveRow& drive = machine.drives[i];
    if (outputs.duty_ratio[k] != 0.0 && is_learnt(drive)) {
      outputs.duty_ratio[k] = learnt_duty(drive, learnt[k], state.opening[k].value());
    } else if (i < 2 && limits.parking[k].parked) {
      outputs.duty_ratio[k] = parked_duty(drive, learnt[k], limits.parking[k].side);
    }
  }
}

/// Duties that lead through the spools' lag; what they add to those.
std::array<double, kDriveCount> lead_spools(const ExcavatorModel& machine, bool leads,
                                            OutputState& state, ExcavatorOutputs& outputs) {
  std::array<double, kDriveCount> lead_ratio{};
  if (!leads) {
    state.spool = {};
    return lead_ratio;
  }
  for (int axis = 0; axis < 2; ++axis) {
    const auto k = static_cast<unsigned>(axis);
    const double wanted = outputs.duty_ratio[k];
    SpoolModel& spool = state.spool[k];
    outputs.duty_ratio[k] = led_duty(
        led_through_s(machine.drives[axis].answer, wanted, spool.travel_ratio), wanted, spool);
    lead_ratio[k] = outputs.duty_ratio[k] - wanted;
  }
  return lead_ratio;
}

/// Swash for what is wanted in this cycle.
void demand_pumps(const ExcavatorModel& machine, const ExcavatorValid& valid,
                  const InputState& inputs, const EstimationState& estimates, const Motion& motion,
                  bool active, double period_s, const LastCycle& last, PumpDemand& pumps) {
  const ExcavatorProfile& profile = machine.profile;
  const auto& blocked = inputs.watch.drives.blocked;
  next_pump_demand(
      profile, machine.valve,
      {valve_input(machine, motion.wanted_mps, valid, estimates), last.flow.line_pa,
       valid.engine_radps, active && !motion.tries, any_blocked(blocked) || any_wary(blocked)},
      period_s, pumps);
  if (active && motion.tries && profile.demand_swash.most_ratio > 0.0) {
    // With less, a load that takes all that a line has hides how its valve opens.
    for (unsigned j = 0; j < static_cast<unsigned>(profile.pump_count); ++j) {
      pumps.swash_ratio[j] = profile.demand_swash.most_ratio;
    }
  }
}

}  // namespace

SentDuties put_out(const ExcavatorModel& machine, const ExcavatorValid& valid,
                   const InputState& inputs, const EstimationState& estimates, const Motion& motion,
                   const LimitState& limits, const Followed& followed, double period_s,
                   const LastCycle& last, ModeDecision& decision, OutputState& state,
                   ExcavatorOutputs& outputs) {
  const GateResult gated =
      motion.tries ? gate_duties(machine.drives, decision.active(), inputs.tried_ratio, period_s,
                                 state.opening, outputs.duty_ratio)
                   : gate_drives(machine.drives, decision.active(), followed.solution.point.spool_m,
                                 period_s, state.opening, outputs.duty_ratio);
  take_refusal(gated.fault, decision);
  outputs.enable = gated.enable;
  if (!motion.tries) {
    open_as_learnt(machine, inputs, limits, state, outputs);
  }
  demand_pumps(machine, valid, inputs, estimates, motion, decision.active(), period_s, last,
               state.pumps);
  outputs.swash_ratio = state.pumps.swash_ratio;
  SentDuties sent;
  sent.duty_ratio = outputs.duty_ratio;
  const bool tried = decision.active() && motion.tries;
  sent.lead_ratio =
      lead_spools(machine, is_on_oil(machine.profile) && outputs.enable && !tried, state, outputs);
  return sent;
}

}  // namespace graben
