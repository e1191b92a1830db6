#include "app/machines/profile_file.hpp"
#include "app/machines/task_file.hpp"

namespace graben::machines {

std::filesystem::path find_profile(const std::string& name) {
  return find_profile(name, {GRABEN_MACHINES_DIR});
}

std::filesystem::path find_task(const std::string& name) {
  return find_task(name, {GRABEN_MACHINES_DIR "/tasks"});
}

}  // namespace graben::machines
