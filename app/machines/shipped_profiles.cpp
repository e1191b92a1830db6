#include <fmt/format.h>

#include <stdexcept>

#include "app/machines/profile_file.hpp"
#include "app/machines/task_file.hpp"

namespace graben::machines {

std::filesystem::path find_profile(const std::string& name) {
  return find_profile(name, {GRABEN_MACHINES_DIR});
}

std::filesystem::path find_machine(const std::string& name, const std::filesystem::path& beside) {
  return find_profile(name, {beside, GRABEN_MACHINES_DIR});
}

std::filesystem::path find_shipped_simulation(const std::string& name) {
  const std::filesystem::path file =
      simulation_file(std::filesystem::path(GRABEN_MACHINES_DIR) / (name + ".toml"));
  if (!std::filesystem::is_regular_file(file)) {
    throw std::runtime_error(fmt::format(
        "simulated machine '{}' not found, neither as a file nor as {}", name, file.string()));
  }
  return file;
}

std::filesystem::path find_task(const std::string& name) {
  return find_task(name, {GRABEN_MACHINES_DIR "/tasks"});
}

}  // namespace graben::machines
