// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/dozer_controller.hpp"

namespace graben {

DozerSetup::DozerSetup(const DozerProfile& machine)
    : profile(machine),
      bank(dozer_bank(profile)),
      blade(profile.blade),
      tilt(profile.tilt),
      design(profile.grade) {}

DozerController::DozerController(const DozerSetup& setup)
    : setup_(setup),
      machine_{setup.profile, setup.bank.rows(), setup.blade, setup.tilt, setup.design},
      memory_(setup),
      preview_(setup.profile, setup.blade) {}

DozerOutputs DozerController::step(const DozerInputs& inputs, TimeUs now_us) {
  const bool intact = memory_.unseal(setup_);
  Memory& is = *memory_;
  const Cycle cycle = begin_cycle(is.cycle, intact, now_us);
  const DozerValid valid = read_inputs(machine_, inputs, cycle, now_us, is.last, is.inputs);
  estimate(machine_, valid, cycle, is.last, is.estimates, preview_);
  const BladeMotion motion =
      wanted_motion(machine_, valid, is.estimates, preview_, cycle.period_s, is.last, is.motion);
  const Travel travel =
      flow_limited(machine_, valid, is.estimates, preview_, motion, cycle.period_s, is.limits);
  ModeDecision decision =
      decide_mode(is.cycle, cycle, valid, Fault::kNone,
                  spools_centred(machine_.drives, valid.drive) && valid.hands_rest(),
                  inputs.link.stop_requested);
  const TriedCommand& tried = is.inputs.tried;
  DozerOutputs outputs;
  put_out(machine_, valid, motion, travel, tried, cycle.period_s, decision, is.output, outputs);
  end_cycle(decision, valid, is.cycle, outputs, outputs.status);
  check_mark(machine_, valid, is.estimates, inputs.driver.touch, now_us, cycle.elapsed_s,
             is.last.mark, outputs.status);
  const bool active = decision.active() && !tried.tries;
  if (active) {
    tell_motion(machine_, is.estimates.pass, motion, travel, valid, outputs.status);
  } else if (decision.active()) {
    tell_tried(tried, valid, outputs.status);
  }
  remember(machine_, valid, is.estimates, motion, travel, tried, decision, outputs, cycle.period_s,
           is.last);
  estimates_after(setup_.profile.grade, active, is.estimates);
  go_on(motion, active, is.motion);
  go_on(travel, active, is.limits);
  memory_.seal();
  return outputs;
}

}  // namespace graben
