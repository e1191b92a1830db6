// SPDX-License-Identifier: Apache-2.0
#include "app/runs/needed_drives.hpp"

#include <fmt/format.h>

#include <cmath>

#include "app/machines/axis_names.hpp"
#include "app/runs/plan_run.hpp"

namespace graben::runs {
namespace {

constexpr double kStep_s = 0.1;
/// m, rad: less is no motion of a task.
constexpr double kMoves = 0.002;

}  // namespace

NeededDrives needed_drives(const ExcavatorProfile& profile, const TaskProgram& program) {
  NeededDrives needed{};
  const auto samples = sample_task(profile, SwingKinematics(profile.geometry), program, kStep_s);
  for (const PlanSample& sample : samples) {
    for (std::size_t k = 0; k < kDriveCount; ++k) {
      const double moved = sample.displacement[k] - samples.front().displacement[k];
      needed[k] = needed[k] || std::abs(moved) > kMoves;
    }
  }
  // From round to round it is led aside.
  needed[kSwing] = needed[kSwing] || program.rounds.offset_m.z() != 0.0;
  return needed;
}

std::string unknown_drives(const machines::ExcavatorMachine& machine, const NeededDrives& needed) {
  std::string unknown;
  bool any_said = false;
  for (int drive = 0; drive < machine.profile.drive_count; ++drive) {
    const auto k = static_cast<std::size_t>(drive);
    for (const bool extends : {true, false}) {
      const bool said = machine.driven[k].side(extends).said;
      any_said = any_said || said;
      if (needed[k] && !said) {
        unknown += (unknown.empty() ? "" : "; ") + machines::side_name(drive, extends);
      }
    }
  }
  return any_said ? unknown : "";
}

}  // namespace graben::runs
