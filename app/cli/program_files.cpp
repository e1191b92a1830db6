// SPDX-License-Identifier: Apache-2.0
#include "app/cli/program_files.hpp"

#include <fmt/format.h>

#include <initializer_list>
#include <stdexcept>

namespace graben::cli {
namespace {

namespace fs = std::filesystem;

/// The first of them that is there, or the last.
fs::path first_there(std::initializer_list<fs::path> files) {
  for (const fs::path& file : files) {
    if (fs::is_regular_file(file)) {
      return file.lexically_normal();
    }
  }
  return (files.end() - 1)->lexically_normal();
}

fs::path own_folder() { return fs::read_symlink("/proc/self/exe").parent_path(); }

}  // namespace

fs::path graben_file() {
  const fs::path file = first_there({own_folder() / "graben", own_folder() / "../../bin/graben"});
  if (!fs::is_regular_file(file)) {
    throw std::runtime_error(fmt::format("{}: not there", file.string()));
  }
  return file;
}

fs::path program_file(const std::string& program) {
  const std::string name = "graben-" + program;
  return first_there({own_folder() / "../libexec/graben" / name, own_folder() / name});
}

}  // namespace graben::cli
