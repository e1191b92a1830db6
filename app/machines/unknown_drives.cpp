// SPDX-License-Identifier: Apache-2.0
#include "app/machines/unknown_drives.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <initializer_list>
#include <stdexcept>

#include "app/machines/axis_names.hpp"

namespace graben::machines {
namespace {

/// Shares of a step at which its drives are looked at.
constexpr int kLooks = 20;
/// m, rad: less is no motion of a task.
constexpr double kMoves = 0.002;

constexpr std::uint32_t bits_of(std::initializer_list<Task> tasks) {
  std::uint32_t bits = 0;
  for (const Task task : tasks) {
    bits |= 1U << static_cast<unsigned>(task);
  }
  return bits;
}

/// Boom, arm and bucket move together in them, by a model of their speeds; in Jog and Commission an
/// operator moves one drive after the other, and sees it.
constexpr std::uint32_t kByCylinders = bits_of({Task::kDig, Task::kCoordinated, Task::kAssist});
constexpr std::uint32_t kByBlade = bits_of({Task::kGrade});

constexpr const char* kReason = "needs drives that were not commissioned";

std::string slow_text() { return fmt::format("at {:.0f} % of the speed", 100.0 * kUnknownSpeed); }

std::string line_of(const std::string& task, const std::string& unknown, UnknownTask how) {
  return unknown.empty() ? ""
                         : fmt::format("{} {}: {}: {}\n", task, kReason, unknown,
                                       how == UnknownTask::kSlow ? slow_text() : "refused");
}

std::string demand(const std::string& name, const std::string& unknown, std::uint32_t tasks,
                   UnknownTask how, UnknownDrives& told) {
  if (unknown.empty()) {
    return "";
  }
  if (how != UnknownTask::kSlow) {
    throw std::runtime_error(
        fmt::format("{}: {}: {}; commission and identify them, or --unknown-drives slow tries it "
                    "slowly",
                    name, kReason, unknown));
  }
  told.tasks = tasks;
  told.speed_ratio = kUnknownSpeed;
  return fmt::format("not commissioned: {}: {}", unknown, slow_text());
}

}  // namespace

NeededDrives needed_drives(const ExcavatorProfile& profile, const TaskProgram& program) {
  NeededDrives needed{};
  const SwingKinematics kinematics(profile.geometry);
  for (int i = 0; i < program.step_count; ++i) {
    const TaskStep& step = program.step[static_cast<unsigned>(i)];
    for (int look = 0; look <= kLooks && step.duration_s() > 0.0; ++look) {
      const double share = static_cast<double>(look) / kLooks;
      const DriveVector at = step_motion(kinematics, step, share).value;
      for (unsigned k = 0; k < kDriveCount; ++k) {
        const double moved = at[k] - program.start[k];
        needed[k] = needed[k] || std::abs(moved) > kMoves;
      }
    }
  }
  // From round to round, and from strip to strip, it is led aside.
  needed[kSwing] =
      needed[kSwing] || program.rounds.offset_m.z() != 0.0 || program.layers.strips > 1;
  return needed;
}

std::string unknown_drives(const ExcavatorMachine& machine, const NeededDrives& needed) {
  std::string unknown;
  bool any_said = false;
  for (int drive = 0; drive < machine.profile.drive_count; ++drive) {
    const auto k = static_cast<std::size_t>(drive);
    for (const bool extends : {true, false}) {
      const bool said = machine.driven[k].side(extends).said;
      any_said = any_said || said;
      if (needed[k] && !said) {
        unknown += (unknown.empty() ? "" : "; ") + side_name(drive, extends);
      }
    }
  }
  return any_said ? unknown : "";
}

std::string unknown_drives(const DozerMachine& machine) {
  return fmt::format("{}",
                     fmt::join(unknown_drives(machine.driven, machine.profile.tilt.present), "; "));
}

void refuse_unknown(ExcavatorMachine& machine) {
  const bool all = unknown_drives(machine, kCylinders).empty();
  machine.profile.safety.unknown = {all ? 0U : kByCylinders, 0U, 0.0};
}

void refuse_unknown(DozerMachine& machine) {
  const bool all = unknown_drives(machine).empty();
  machine.profile.safety.unknown = {all ? 0U : kByBlade, 0U, 0.0};
}

std::string prepare_unknown(ExcavatorMachine& machine, const TaskBook& book, UnknownTask how) {
  UnknownDrives& told = machine.profile.safety.unknown;
  told.speed_ratio = how == UnknownTask::kSlow ? kUnknownSpeed : 0.0;
  std::string lines =
      line_of("dig, coordinated levers and assist:", unknown_drives(machine, kCylinders), how);
  for (int i = 0; i < book.count; ++i) {
    const auto k = static_cast<unsigned>(i);
    const std::string unknown =
        unknown_drives(machine, needed_drives(machine.profile, book.program[k]));
    told.programs |= unknown.empty() ? 0U : 1U << k;
    lines += line_of(fmt::format("task {}", i), unknown, how);
  }
  return lines;
}

std::string prepare_unknown(DozerMachine& machine, UnknownTask how) {
  machine.profile.safety.unknown.speed_ratio = how == UnknownTask::kSlow ? kUnknownSpeed : 0.0;
  return line_of("grade", unknown_drives(machine), how);
}

std::string demand_known(ExcavatorMachine& machine, const NeededDrives& needed, UnknownTask how) {
  return demand(machine.name, unknown_drives(machine, needed),
                kByCylinders | bits_of({Task::kProgram}), how, machine.profile.safety.unknown);
}

std::string demand_known(DozerMachine& machine, UnknownTask how) {
  return demand(machine.name, unknown_drives(machine), kByBlade, how,
                machine.profile.safety.unknown);
}

}  // namespace graben::machines
