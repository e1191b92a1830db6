// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/inputs/inputs.hpp"

namespace graben {

DozerValid read_inputs(const DozerModel& machine, const DozerInputs& inputs, const Cycle& cycle,
                       TimeUs now_us, const DozerLastCycle& last, DozerInputState& state) {
  const DriveRows& drives = machine.drives;
  const bool moving = last.commands.drives.moving;
  DozerValid valid = validate(machine.profile, drives, inputs, moving, now_us, state.validation);
  watch(machine.profile, drives, last.commands, cycle.elapsed_s, state.watch, valid);
  tell_stall(last.stall, machine.profile.safety.stall_s, valid);
  tell_tube(last.tube, valid);
  tell_tube(last.off_track, valid);
  tell_mark(machine.profile.mark, last.mark, moving, valid);
  tell_unknown(machine.profile.safety.unknown, valid);
  tell_external(inputs.external, moving, now_us, cycle.period_s, state.external, valid);
  const bool at_rest = spools_centred(drives, valid.drive) && tracks_at_rest(valid);
  const std::array<double, kBladeCount> stroke_m = {valid.blade().stroke_m, valid.tilt().stroke_m};
  const TaskChoice task =
      task_after_change(state.change, {valid.task, valid.task_number}, moving, at_rest,
                        {stroke_m.data(), drives.count()}, cycle.period_s);
  valid.task = task.task;
  guard_tried(machine, cycle, last, valid, state);
  return valid;
}

}  // namespace graben
