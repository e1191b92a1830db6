// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/outputs/outputs.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/drives/way_watch.hpp"
#include "firmware/excavator/outputs/tuning.hpp"
#include "firmware/excavator/tuning.hpp"

namespace graben {
namespace {

/// Time constant of the side to which a spool is to go, that is led through; 0 of one that is too
/// slow for it.
double led_through_s(const SpoolAnswers& answer, double wanted_ratio, double travel_ratio) {
  const bool extends = wanted_ratio != 0.0 ? wanted_ratio > 0.0 : travel_ratio > 0.0;
  const double constant_s = answer.side(extends).spool_time_constant_s;
  return constant_s <= kLedSpoolMost_s ? constant_s : 0.0;
}

using Duties = std::array<double, kDriveCount>;

/// Duties of openings, for the valves as they turned out to be.
Duties open_as_learnt(const ExcavatorModel& machine, const InputState& inputs,
                      const LimitState& limits, const Followed& followed, double period_s,
                      OutputState& state) {
  Duties duty_ratio{};
  open_spools(machine.drives, followed.solution.point.spool_m, period_s, state.opening, duty_ratio);
  if (machine.profile.control.law == ControlLaw::kKim) {
    return duty_ratio;
  }
  const auto& learnt = inputs.watch.drives.learnt;
  for (int i = 0; i < machine.drives.count(); ++i) {
    const auto k = static_cast<unsigned>(i);
    const DriveRow& drive = machine.drives[i];
    if (duty_ratio[k] != 0.0 && is_learnt(drive)) {
      duty_ratio[k] = learnt_duty(drive, learnt[k], state.opening[k]);
    } else if (i < 2 && limits.parking[k].parked) {
      duty_ratio[k] = parked_duty(drive, learnt[k], limits.parking[k].side);
    }
  }
  return duty_ratio;
}

LedThrough led_through(const ExcavatorModel& machine, const Duties& wanted,
                       const OutputState& state) {
  LedThrough time_s{};
  for (unsigned k = 0; k < time_s.size(); ++k) {
    time_s[k] = led_through_s(machine.drives[static_cast<int>(k)].answer, wanted[k],
                              state.spool[k].model.travel_ratio);
  }
  return time_s;
}

/// The spools that are led, a cycle on with what was sent.
void spools_after(OutputState& state) {
  for (unsigned k = 0; k < state.led_s.size(); ++k) {
    next_led(state.led_s[k], state.sent[k], state.spool[k]);
  }
}

/// What the measured spools say of their models.
void judge_models(const ExcavatorModel& machine, const ExcavatorValid& valid, OutputState& state) {
  for (unsigned k = 0; k < state.led_s.size(); ++k) {
    if (machine.drives[static_cast<int>(k)].watch.senses_spool) {
      judge_model(state.led_s[k], valid.drive[k].spool_ratio, state.spool[k]);
    }
  }
}

/// `wanted` through the gate, led through the spools' lag if `leads`.
GateResult send(const ExcavatorModel& machine, const ExcavatorValid& valid, bool active, bool leads,
                const Duties& wanted, const Cycle& cycle, OutputState& state, Duties& duty_ratio) {
  // The spools have gone on by one cycle; by more, if this one comes late.
  for (int n = 1; n < cycles_in(cycle.elapsed_s); ++n) {
    spools_after(state);
  }
  Duties led = wanted;
  const LedThrough time_s = led_through(machine, wanted, state);
  if (leads && valid.fault == Fault::kNone) {
    judge_models(machine, valid, state);
  }
  for (unsigned k = 0; leads && k < time_s.size(); ++k) {
    led[k] = trusted_lead(time_s[k], wanted[k], state.spool[k]);
  }
  const GateResult gated =
      gate_duties(machine.drives, active, led, cycle.period_s, state.sent, duty_ratio);
  if (!leads || !gated.enable) {
    state.spool = {};
    return gated;
  }
  state.led_s = time_s;
  spools_after(state);
  return gated;
}

/// Of each pump's drives, the largest share that one lacks of its wanted speed, as guards leave it.
/// Of those that press alone: a stroke that only seems to stand is no reason to push harder.
PerPump<double> short_shares(const ExcavatorModel& machine, const ExcavatorValid& valid,
                             const InputState& inputs, const Motion& motion) {
  PerPump<double> lacks{};
  for (int i = 0; i < kAxisCount; ++i) {
    const auto k = static_cast<unsigned>(i);
    const double wanted_mps = motion.cap.factor * motion.wanted_mps[i];
    if (wanted_mps != 0.0 && presses(machine.drives[i], valid.drive[k], wanted_mps)) {
      const double share = 1.0 - inputs.accepted[k].speed_mps / wanted_mps;
      const double counts = std::abs(wanted_mps) / (std::abs(wanted_mps) + kShortHalf_mps);
      double& most = lacks[static_cast<unsigned>(machine.valve.actuator[k].pump)];
      most = std::max(most, counts * std::clamp(share, 0.0, 1.0));
    }
  }
  return lacks;
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
       valid.engine_radps, short_shares(machine, valid, inputs, motion), active && !motion.tries,
       any_blocked(blocked) || any_wary(blocked), reserve_ratio(motion)},
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
                   const LimitState& limits, const Followed& followed, const Cycle& cycle,
                   const LastCycle& last, ModeDecision& decision, OutputState& state,
                   ExcavatorOutputs& outputs) {
  SentDuties sent;
  if (decision.active()) {
    if (motion.tries) {
      step_duties(machine.drives, inputs.tried_ratio, cycle.period_s, state.sent, sent.duty_ratio);
      state.opening = {};
    } else {
      sent.duty_ratio = open_as_learnt(machine, inputs, limits, followed, cycle.period_s, state);
    }
  }
  const bool leads = is_on_oil(machine.profile) && !motion.tries;
  const GateResult gated = send(machine, valid, decision.active(), leads, sent.duty_ratio, cycle,
                                state, outputs.duty_ratio);
  take_refusal(gated.fault, decision);
  outputs.enable = gated.enable;
  if (!gated.enable) {
    state.opening = {};
    sent.duty_ratio = {};
  }
  for (unsigned k = 0; k < kDriveCount; ++k) {
    sent.lead_ratio[k] = outputs.duty_ratio[k] - sent.duty_ratio[k];
  }
  demand_pumps(machine, valid, inputs, estimates, motion, decision.active(), cycle.period_s, last,
               state.pumps);
  outputs.swash_ratio = state.pumps.swash_ratio;
  return sent;
}

}  // namespace graben
