// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/inputs/inputs.hpp"

#include <array>
#include <cmath>

#include "firmware/excavator/inputs/measured_joints.hpp"

namespace graben {
namespace {

/// No spool is open, as far as anybody knows: by where the spools are, or, where nobody says that,
/// by our own commands. What then moves a link moves it slowly.
bool is_still(const ExcavatorProfile& profile, const ExcavatorInputs& inputs, EcuMode last_mode) {
  if (!profile.bus.spool_feedback) {
    return last_mode != EcuMode::kActive;
  }
  bool still = true;
  for (const AxisInputs& axis : inputs.axis) {
    still = still && axis.spool_ratio.validity == Validity::kValid &&
            std::abs(axis.spool_ratio.value) <= profile.safety.spool_tolerance;
  }
  return still;
}

std::array<Signal<double>, kAxisCount> strokes_by_angles(const ExcavatorModel& machine,
                                                         const ExcavatorInputs& inputs,
                                                         InputState& state) {
  std::array<Signal<double>, kAxisCount> joint_rad = inputs.joint_rad;
  for (unsigned axis = 0; axis < kAxisCount; ++axis) {
    joint_rad[axis] =
        foretold(inputs.joint_rad[axis], machine.profile.bus.joint_latency_s, state.foretold[axis]);
  }
  const std::array<Signal<double>, kAxisCount> strokes_m =
      strokes_of_joints(machine.kinematics.planar(), joint_rad);
  state.joints = {};
  state.joints.known = true;
  for (unsigned axis = 0; axis < kAxisCount; ++axis) {
    state.joints.known = state.joints.known && strokes_m[axis].validity == Validity::kValid;
    state.joints.joint[axis].angle_rad = joint_rad[axis].value;
    state.joints.stroke_m[axis] = strokes_m[axis].value;
  }
  return strokes_m;
}

std::array<Signal<double>, kAxisCount> strokes_by_imus(const ExcavatorModel& machine,
                                                       const ExcavatorInputs& inputs,
                                                       const Cycle& cycle, InputState& state) {
  const ImuStrokes by_imus = next_imu_strokes(
      machine.kinematics.planar(), machine.profile.imu, inputs,
      is_still(machine.profile, inputs, cycle.last_mode), cycle.elapsed_s, state.imus);
  state.joints = by_imus.joints;
  return by_imus.stroke_m;
}

/// Inputs that may be used, the strokes by whatever the machine measures: encoders, angles of the
/// joints, or IMUs on the links.
ExcavatorValid validated_strokes(const ExcavatorModel& machine, const ExcavatorInputs& inputs,
                                 const Cycle& cycle, TimeUs now_us, bool moving,
                                 InputState& state) {
  const ExcavatorProfile& profile = machine.profile;
  if (profile.imu.known()) {
    return validate(profile, machine.drives, inputs, moving, now_us, state.accepted,
                    strokes_by_imus(machine, inputs, cycle, state));
  }
  if (profile.bus.joint_angles) {
    return validate(profile, machine.drives, inputs, moving, now_us, state.accepted,
                    strokes_by_angles(machine, inputs, state));
  }
  return validate(profile, machine.drives, inputs, moving, now_us, state.accepted);
}

/// Bits of the programs that there are. [-; size: of the word]
constexpr int kProgramBits = 32;

/// kTaskUnknown unless the task that the operator asks for is there, a program with steps.
FaultSet task_faults(const ExcavatorValid& valid, std::uint32_t programs) {
  const bool known =
      valid.task == Task::kNone || is_by_field(valid.task) || is_by_lever(valid.task) ||
      valid.task == Task::kCommission ||
      (valid.task == Task::kProgram && valid.task_number >= 0 && valid.task_number < kProgramBits &&
       (programs >> static_cast<unsigned>(valid.task_number) & 1U) != 0);
  FaultSet faults;
  faults.add(known ? Fault::kNone : Fault::kTaskUnknown);
  return faults;
}

/// kOperatorMissing where the levers that lead the machine come as those of a station that has
/// promised more.
FaultSet lever_faults(const SafetyProfile& safety, const ExcavatorValid& valid, bool moving,
                      double period_s, LeverWatch& state) {
  FaultSet faults;
  if (levers_stand_still(safety.levers_alive_s, moving && is_by_lever(valid.task),
                         valid.lever_ratio, period_s, state)) {
    faults.add(Fault::kOperatorMissing);
  }
  return faults;
}

}  // namespace

ExcavatorValid read_inputs(const ExcavatorModel& machine, std::uint32_t programs,
                           const ExcavatorInputs& inputs, const Cycle& cycle, TimeUs now_us,
                           const LastCycle& last, InputState& state) {
  const DriveRows& drives = machine.drives;
  ExcavatorValid valid =
      validated_strokes(machine, inputs, cycle, now_us, last.commands.moving, state);
  watch_seconds(machine.profile, drives, inputs, last.commands.moving, now_us, state.seconds,
                valid);
  watch(machine.profile, drives, last.commands, last.swash_ratio, cycle.elapsed_s, state.watch,
        valid);
  stop(task_faults(valid, programs), valid);
  tell_unknown(machine.profile.safety.unknown, valid);
  stop(lever_faults(machine.profile.safety, valid, last.commands.moving, cycle.elapsed_s,
                    state.levers),
       valid);
  if (any_blocked(state.watch.drives.blocked)) {
    warn(Fault::kBlocked, valid);
  }
  tell_stall(last.stall, machine.profile.safety.stall_s, valid);
  tell_tube(last.tube, valid);
  tell_mark(machine.profile.mark, last.mark, last.commands.moving, valid);
  tell_external(inputs.external, last.commands.moving, now_us, cycle.period_s, state.external,
                valid);
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
