#pragma once
/// The tasks that an operator may choose from, read and planned before anything moves.

#include <filesystem>
#include <string>
#include <vector>

#include "firmware/excavator/tasks/task_program.hpp"

namespace graben::machines {

/// Tasks by file or by name in the folders, at most kTaskMost; the first has the number 0. Throws
/// std::runtime_error with every error of every one of them.
[[nodiscard]] TaskBook load_tasks(const std::vector<std::string>& names,
                                  const std::vector<std::filesystem::path>& folders,
                                  const ExcavatorProfile& profile);

}  // namespace graben::machines
