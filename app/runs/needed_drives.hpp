// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A task beside what a profile says to have been measured.

#include <array>
#include <string>

#include "app/machines/excavator_file.hpp"
#include "firmware/excavator/motion/program/task_program.hpp"

namespace graben::runs {

/// Drives that a task moves, as excavator_bank has them.
using NeededDrives = std::array<bool, kDriveCount>;

/// Boom, arm and bucket.
inline constexpr NeededDrives kCylinders = {true, true, true, false};

/// Those of a planned task: those that its plan moves, the swing too where its rounds are set
/// aside.
[[nodiscard]] NeededDrives needed_drives(const ExcavatorProfile& profile,
                                         const TaskProgram& program);

/// "swing, left; swing, right": sides of needed drives that a profile by `graben identify` does not
/// say to have been measured. Empty: none, or nothing at all was measured, as of a shipped profile.
[[nodiscard]] std::string unknown_drives(const machines::ExcavatorMachine& machine,
                                         const NeededDrives& needed);

}  // namespace graben::runs
