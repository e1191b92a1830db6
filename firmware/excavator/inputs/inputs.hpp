// SPDX-License-Identifier: Apache-2.0
#pragma once
/// First stage of a cycle: from signals to what may be used of them, with every fault that they
/// show.

#include "firmware/drives/commission_guard.hpp"
#include "firmware/estimation/foretold_angle.hpp"
#include "firmware/excavator/inputs/imu_joints.hpp"
#include "firmware/excavator/inputs/lever_watch.hpp"
#include "firmware/excavator/safety/excavator_validation.hpp"
#include "firmware/excavator/stage.hpp"
#include "firmware/safety/cycle.hpp"
#include "firmware/safety/external_limit.hpp"
#include "firmware/safety/task_change.hpp"

namespace graben {

/// State from cycle to cycle.
struct InputState {
  std::array<AcceptedStroke, kDriveCount> accepted;
  ImuState imus;
  std::array<ForetoldAngle, kAxisCount> foretold;  ///< Of measured joints that come late.
  JointAngles joints;
  SecondStates seconds;
  ExcavatorWatchState watch;
  TaskChangeState change;
  LeverWatch levers;
  ExternalState external;
  std::array<CommissionState, kDriveCount> commission;
  std::array<double, kDriveCount> tried_ratio{};  ///< Duties of this cycle that may be sent.
};

/// Strokes by their sensors, by IMUs or by measured joints, validated and watched against what the
/// last cycle commanded; the task that is to be followed, of the programs that have a
/// bit in `programs`, from the lowest on, and the others; the duties to try that may be sent.
[[nodiscard]] ExcavatorValid read_inputs(const ExcavatorModel& machine, std::uint32_t programs,
                                         const ExcavatorInputs& inputs, const Cycle& cycle,
                                         TimeUs now_us, const LastCycle& last, InputState& state);

/// Guards duties that are tried while a machine is commissioned, on valves of which nothing is
/// known, and gives those that may be sent in `state.tried_ratio`; what holds them back is in
/// `state.commission`. What a drive does wrong stops, where nothing else does. The swing's duty is
/// what its lever says, its window its own range at its fastest.
void guard_tried_duties(DriveRows drives, const Cycle& cycle, const LastCommands<kDriveCount>& last,
                        ExcavatorValid& valid, InputState& state);

/// Of the first drive that its window holds back.
[[nodiscard]] Limit tried_limit(DriveRows drives,
                                const std::array<CommissionState, kDriveCount>& commission);

/// True where a velocity field leads the teeth (motion/field).
[[nodiscard]] inline bool is_by_field(Task task) { return task == Task::kDig; }

}  // namespace graben
