// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Tasks beside what a profile says to have been commissioned. A profile that says so of some
/// drives has tasks that need another one refused, by its controller too (firmware/machine); one
/// that says nothing, as a shipped one, has not.

#include <array>
#include <string>

#include "app/machines/dozer_file.hpp"
#include "app/machines/excavator_file.hpp"
#include "firmware/excavator/motion/program/task_program.hpp"

namespace graben::machines {

/// Drives that a task moves, as excavator_bank has them.
using NeededDrives = std::array<bool, kDriveCount>;

/// Boom, arm and bucket.
inline constexpr NeededDrives kCylinders = {true, true, true, false};
inline constexpr NeededDrives kEveryDrive = {true, true, true, true};

/// Those of a planned task: those that its plan moves, the swing too where its rounds are set aside
/// or its layers are in strips. None of one without steps.
[[nodiscard]] NeededDrives needed_drives(const ExcavatorProfile& profile,
                                         const TaskProgram& program);

/// "swing, left; swing, right": sides of needed drives that a profile by `graben identify` does not
/// say to have been measured. Empty: none, or nothing at all was measured, as of a shipped profile.
[[nodiscard]] std::string unknown_drives(const ExcavatorMachine& machine,
                                         const NeededDrives& needed);
/// The same of a dozer, whose tasks need every drive there is.
[[nodiscard]] std::string unknown_drives(const DozerMachine& machine);

/// What is done with a task that needs drives which were not commissioned.
enum class UnknownTask { kRefused, kSlow };

/// Of the speed that is asked for, in tasks with drives that were not commissioned.
inline constexpr double kUnknownSpeed = 0.3;

/// Has the controller of a machine refuse what needs drives that were not commissioned, of an
/// excavator dig, coordinated levers and assist; every profile is read so.
void refuse_unknown(ExcavatorMachine& machine);
void refuse_unknown(DozerMachine& machine);

/// For a controller that can be asked for any task: the same of each program of the book, and all
/// of them refused, or done slowly, as `how` says. "task 0 needs drives that were not commissioned:
/// swing, left: refused", a line for each; empty where every drive is known.
[[nodiscard]] std::string prepare_unknown(ExcavatorMachine& machine, const TaskBook& book,
                                          UnknownTask how);
[[nodiscard]] std::string prepare_unknown(DozerMachine& machine, UnknownTask how);

/// Before a task that needs these drives is done: nothing where all of them are known. Else, with
/// kSlow, its controller does every task slowly, which is said: "not commissioned: swing, left: at
/// 30 % of the speed". Throws std::runtime_error, which names them, without.
[[nodiscard]] std::string demand_known(ExcavatorMachine& machine, const NeededDrives& needed,
                                       UnknownTask how);
[[nodiscard]] std::string demand_known(DozerMachine& machine, UnknownTask how);

}  // namespace graben::machines
