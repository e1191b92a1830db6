#include "app/machines/task_book.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "app/machines/task_file.hpp"

namespace graben::machines {

TaskBook load_tasks(const std::vector<std::string>& names,
                    const std::vector<std::filesystem::path>& folders,
                    const ExcavatorProfile& profile) {
  if (names.size() > kTaskMost) {
    throw std::runtime_error(fmt::format("{} tasks; allowed: at most {}", names.size(), kTaskMost));
  }
  TaskBook book;
  std::vector<std::string> errors;
  for (const std::string& name : names) {
    try {
      TaskProgram& program = book.program[static_cast<unsigned>(book.count++)];
      program = load_task(find_task(name, folders), profile).result.program;
    } catch (const std::exception& error) {
      errors.emplace_back(error.what());
    }
  }
  if (!errors.empty()) {
    throw std::runtime_error(fmt::format("{}", fmt::join(errors, "\n")));
  }
  return book;
}

}  // namespace graben::machines
