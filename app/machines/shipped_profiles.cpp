// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <stdexcept>
#include <system_error>

#include "app/machines/bus_file.hpp"
#include "app/machines/near_word.hpp"
#include "app/machines/profile_file.hpp"
#include "app/machines/task_file.hpp"
#ifndef GRABEN_MACHINES_DIR
#include <sys/auxv.h>
#endif

namespace graben::machines {
namespace {

namespace fs = std::filesystem;

#ifdef GRABEN_MACHINES_DIR
/// Without an operating system a program, a test, is in no folder.
fs::path find_shipped_folder() { return GRABEN_MACHINES_DIR; }
#else
/// share/graben/machines beside a folder that the program is in: of /usr/bin it is in /usr; the
/// build folder has one as well, a link to the sources'. So the program knows no path of its own.
fs::path find_shipped_folder() {
  std::error_code error;
  fs::path folder = fs::read_symlink("/proc/self/exe", error);
  if (error) {
    // No /proc, as in a bare chroot: the name that it was called by.
    folder = fs::canonical(reinterpret_cast<const char*>(getauxval(AT_EXECFN)), error);
  }
  while (!error && folder.has_relative_path()) {
    folder = folder.parent_path();
    const fs::path shipped = folder / "share" / "graben" / "machines";
    if (fs::is_directory(shipped, error)) {
      return shipped;
    }
    error.clear();
  }
  return fs::path("share") / "graben" / "machines";
}
#endif

const fs::path& shipped_folder() {
  static const fs::path folder = find_shipped_folder();
  return folder;
}

}  // namespace

std::vector<fs::path> shipped_folders() { return {shipped_folder(), "/usr/share/graben"}; }

std::vector<std::string> shipped_profile_names() { return file_names({shipped_folder()}); }

std::vector<std::string> shipped_task_names() { return file_names({shipped_folder() / "tasks"}); }

std::vector<std::string> shipped_simulation_names() { return simulation_names(shipped_folder()); }

std::vector<std::string> shipped_bus_names() { return file_names({shipped_folder() / "buses"}); }

fs::path find_profile(const std::string& name) { return find_profile(name, {shipped_folder()}); }

fs::path find_machine(const std::string& name, const fs::path& beside) {
  return find_profile(name, {beside, shipped_folder()});
}

fs::path find_shipped_simulation(const std::string& name) {
  fs::path file = simulation_file(shipped_folder() / (name + ".toml"));
  if (!fs::is_regular_file(file)) {
    const std::vector<std::string> there = shipped_simulation_names();
    throw std::runtime_error(fmt::format(
        "simulated machine '{}': there is no such file, nor one of that name in {}; wanted: a file "
        "or one of {}{}",
        name, shipped_folder().string(), fmt::join(there, ", "), near_word_hint(name, there)));
  }
  return file;
}

fs::path find_design(const fs::path& name) {
  std::error_code error;
  for (const fs::path& folder : {shipped_folder(), shipped_folder().parent_path() / "designs"}) {
    const bool is_name = !name.has_parent_path() && !fs::exists(name, error);
    if (is_name && fs::is_regular_file(folder / name, error)) {
      return folder / name;
    }
  }
  return name;
}

fs::path find_bus(const std::string& name) { return find_bus(name, {shipped_folder() / "buses"}); }

fs::path find_task(const std::string& name) {
  return find_task(name, {shipped_folder() / "tasks"});
}

}  // namespace graben::machines
