// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/inputs/inputs.hpp"

#include "firmware/excavator/inputs/strokes.hpp"
#include "firmware/excavator/inputs/tried_duties.hpp"

namespace graben {
namespace {

/// kTaskUnknown unless the task that the operator asks for is there.
FaultSet task_faults(const ExcavatorValid& valid, int program_count) {
  const bool known =
      valid.task == Task::kNone || valid.task == Task::kDig || is_by_lever(valid.task) ||
      valid.task == Task::kCommission ||
      (valid.task == Task::kProgram && valid.task_number >= 0 && valid.task_number < program_count);
  FaultSet faults;
  faults.add(known ? Fault::kNone : Fault::kTaskUnknown);
  return faults;
}

}  // namespace

ExcavatorValid read_inputs(const ExcavatorModel& machine, int program_count,
                           const ExcavatorInputs& inputs, const Cycle& cycle, TimeUs now_us,
                           const LastCycle& last, InputState& state) {
  const DriveRows& drives = machine.drives;
  ExcavatorValid valid =
      validated_strokes(machine, inputs, cycle, now_us, last.commands.moving, state);
  watch(machine.profile, drives, last.commands, last.swash_ratio, cycle.elapsed_s, state.watch,
        valid);
  stop(task_faults(valid, program_count), valid);
  if (any_blocked(state.watch.drives.blocked)) {
    warn(Fault::kBlocked, valid);
  }
  tell_stall(last.stall, machine.profile.safety.stall_s, valid);
  tell_tube(last.tube, valid);
  const DriveVector travel_m = valid.strokes_m();
  const TaskChoice task = task_after_change(
      state.change, {valid.task, valid.task_number}, last.commands.moving,
      spools_centred(drives, valid.drive), {travel_m.data(), drives.count()}, cycle.period_s);
  valid.task = task.task;
  valid.task_number = task.number;
  guard_tried_duties(drives, cycle, last.commands, valid, state);
  return valid;
}

}  // namespace graben
