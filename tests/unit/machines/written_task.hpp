// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Texts of task files, and what is said of them.

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "app/machines/excavator_file.hpp"
#include "app/machines/task_file.hpp"
#include "tests/unit/cmocka_cpp.hpp"

namespace graben::test {

inline const ExcavatorProfile& profile(const char* name) {
  static const machines::ExcavatorMachine small =
      machines::load_excavator(machines::find_profile("excavator_12t"));
  static const machines::ExcavatorMachine large =
      machines::load_excavator(machines::find_profile("excavator_22t"));
  return std::string(name) == "excavator_12t" ? small.profile : large.profile;
}

inline std::string shipped(const char* name) {
  std::ifstream in(machines::find_task(name));
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A task file with this text, for as long as it is looked at.
class Written {
 public:
  explicit Written(const std::string& text)
      : path_(std::filesystem::temp_directory_path() /
              ("graben_task_" + std::to_string(getpid()) + ".toml")) {
    std::ofstream(path_) << text;
  }
  ~Written() { std::filesystem::remove(path_); }
  Written(const Written&) = delete;
  Written& operator=(const Written&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// The errors of a text, one a line; empty if it is a task.
inline std::string errors_of(const std::string& text, const char* machine = "excavator_12t") {
  const Written file(text);
  try {
    static_cast<void>(machines::load_task(file.path(), profile(machine)));
  } catch (const machines::ProfileError& error) {
    std::string all;
    for (const std::string& line : error.errors()) {
      all += line + "\n";
    }
    return all;
  }
  return "";
}

/// The shipped text with one part of it replaced.
inline std::string edited(const char* name, const std::string& from, const std::string& to) {
  std::string text = shipped(name);
  const std::size_t at = text.find(from);
  assert_true(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

inline void assert_says(const std::string& errors, const std::string& what) {
  if (errors.find(what) == std::string::npos) {
    print_error("'%s' not in:\n%s", what.c_str(), errors.c_str());
    _fail(__FILE__, __LINE__);
  }
}

}  // namespace graben::test
