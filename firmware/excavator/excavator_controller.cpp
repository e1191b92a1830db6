// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/excavator_controller.hpp"

namespace graben {

ExcavatorSetup::ExcavatorSetup(const ExcavatorProfile& machine, const TaskBook& tasks)
    : profile(machine),
      book(tasks),
      bank(excavator_bank(profile)),
      kinematics(profile.geometry),
      field(profile, kinematics.planar()),
      valve(mcv_machine(profile)),
      oil(oil_gains(profile)) {}

ExcavatorController::ExcavatorController(const ExcavatorSetup& setup)
    : machine_{setup.profile, setup.bank.rows(), setup.kinematics, setup.valve},
      sources_{setup.book, setup.field, setup.oil} {}

ExcavatorOutputs ExcavatorController::step(const ExcavatorInputs& inputs, TimeUs now_us) {
  Memory& is = *memory_;
  const Cycle cycle = begin_cycle(is.cycle, memory_.unseal(), now_us);
  ExcavatorValid valid =
      read_inputs(machine_, sources_.book.with_steps(), inputs, cycle, now_us, is.last, is.inputs);
  tell_site(sources_.book, is.last.site, valid);
  const Motion motion = next_motion(valid, cycle);
  const Followed followed =
      flow_limited(machine_, valid, is.estimates, motion, cycle.period_s, is.last);
  ModeDecision decision =
      decide_mode(is.cycle, cycle, valid, first_of({motion.fault, solver_fault(followed.solution)}),
                  spools_centred(machine_.drives, valid.drive) && valid.hands_rest(),
                  inputs.link.stop_requested);
  ExcavatorOutputs outputs;
  const SentDuties sent = put_out(machine_, valid, is.inputs, is.estimates, motion, is.limits,
                                  followed, cycle, is.last, decision, is.output, outputs);
  end_cycle(decision, valid, is.cycle, outputs, outputs.status);
  tell_seen(machine_, is.inputs, is.estimates, outputs.status);
  check_touches(machine_, sources_.book, valid, is.estimates.pose, inputs.driver.touch,
                is.inputs.imus.link[kBodyImu].then.turning_radps, now_us, cycle.elapsed_s, is.last,
                outputs.status);
  if (decision.active()) {
    tell_motion(machine_, is.inputs, motion, followed, valid, outputs.status);
  }
  remember(machine_, valid, is.inputs, motion, followed, decision, is.output, sent, outputs.enable,
           cycle.period_s, is.last);
  go_on(machine_, sources_.book, valid, motion,
        {decision.active(), decision.active() ? followed.of_way() * motion.cap.factor : 0.0},
        is.estimates.load_observer.told, cycle.period_s, is.motion);
  memory_.seal();
  return outputs;
}

LearntDrives ExcavatorController::learnt() const { return learnt_of(memory_->inputs.watch.drives); }

bool ExcavatorController::begin(const LearntDrives& learnt) {
  if (!is_sound(learnt) || !memory_.intact()) {
    return false;
  }
  if (machine_.profile.control.learns) {
    begin_learnt(learnt, memory_->inputs.watch.drives);
    memory_.seal();
  }
  return true;
}

bool ExcavatorController::site_is_left() const {
  return is_left(sources_.book.site, memory_->last.site);
}

void ExcavatorController::begin_left_site() {
  if (memory_.intact()) {
    memory_->last.site.begins_left = true;
    memory_.seal();
  }
}

Motion ExcavatorController::next_motion(const ExcavatorValid& valid, const Cycle& cycle) {
  Memory& is = *memory_;
  const MotionUnderWay under_way = motion_under_way(machine_, sources_.book, valid, is.motion);
  estimate(machine_, sources_.oil, valid, is.inputs, under_way, cycle, is.last, is.estimates);
  Motion motion = wanted_motion(machine_, sources_, valid, is.inputs, is.estimates, cycle.period_s,
                                is.last, is.motion);
  hold_back(machine_, valid, is.inputs, is.estimates, cycle.period_s, is.last, motion, is.limits);
  return motion;
}

ProfileCheck profile_check(const ExcavatorProfile& profile) {
  const ExcavatorKinematics kinematics(profile.geometry);
  const DigField field(profile, kinematics);
  return {check_machine(mcv_machine(profile)), field.reach(), field.unreached()};
}

}  // namespace graben
