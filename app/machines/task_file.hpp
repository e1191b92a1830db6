// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Tasks as files: TOML in, checked and planned as a whole for one machine.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/machines/height_grid.hpp"
#include "app/machines/profile_file.hpp"
#include "firmware/excavator/motion/program/task_program.hpp"

namespace graben::machines {

class TomlReader;

/// A task as its file describes it, and what became of it on the machine that it was read for.
struct TaskFile {
  std::string name;        ///< File name without its ending.
  std::uint32_t hash = 0;  ///< Of the checked values: TomlReader::hash.
  ProgramRequest request;
  ProgramResult result;  ///< Never a refusal.
  /// Memory of the design, where it is no plane: the last of the program's fences looks at it, so
  /// it has to be kept as long as anything has one of these.
  std::shared_ptr<const HeldSurface> surface;
  std::optional<SiteSection> site;  ///< That its design lies on.

  /// It has steps; else it only says, for task Assist, what is to be made and what must not be
  /// passed.
  [[nodiscard]] bool has_steps() const { return request.step_count > 0; }
};

/// What a task's file says, before it is planned.
struct TaskContent {
  ProgramRequest request;
  std::shared_ptr<const HeldSurface> surface;
  std::optional<SiteSection> site;
};

/// Programs that can be chosen, and the memory of their surfaces.
struct TaskShelf {
  TaskBook book;
  std::vector<std::shared_ptr<const HeldSurface>> surfaces;
};

/// Reads, checks and plans a task. Throws ProfileError with every error found; a task that can't be
/// planned on this machine is one, and says which step, what is in the way and where.
[[nodiscard]] TaskFile load_task(const std::filesystem::path& file,
                                 const ExcavatorProfile& profile);

/// Throws std::runtime_error where a task has no steps, with what is wanted of it: "autodig".
void demand_steps(const TaskFile& task, const std::string& wanted_by);

/// All that a task file of each kind has to say; errors are with the reader. A design's file is
/// looked for in `folder`.
[[nodiscard]] TaskContent read_step_task(TomlReader& reader, const ExcavatorProfile& profile,
                                         const std::filesystem::path& folder);
[[nodiscard]] ProgramRequest read_area_task(TomlReader& reader, const ExcavatorProfile& profile);

/// Finds `name` as a path, or as NAME or NAME.toml in one of the folders, like find_profile.
[[nodiscard]] std::filesystem::path find_task(const std::string& name,
                                              const std::vector<std::filesystem::path>& folders);
/// The same among the tasks of this source tree.
[[nodiscard]] std::filesystem::path find_task(const std::string& name);

/// Tasks by file or by name in the folders, at most kTaskMost; the first has the number 0. Throws
/// std::runtime_error with every error of every one of them, and where their designs lie on sites
/// that are given otherwise: the machine stands in one place.
[[nodiscard]] TaskShelf load_tasks(const std::vector<std::string>& names,
                                   const std::vector<std::filesystem::path>& folders,
                                   const ExcavatorProfile& profile);

}  // namespace graben::machines
