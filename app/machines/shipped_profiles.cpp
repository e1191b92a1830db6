#include "app/machines/profile_file.hpp"

namespace graben::machines {

std::filesystem::path find_profile(const std::string& name) {
  return find_profile(name, {GRABEN_MACHINES_DIR});
}

}  // namespace graben::machines
