// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/unit/cmocka_cpp.hpp"

namespace graben::test {

/// A folder of its own, gone with it.
struct Folder {
  Folder()
      : path(std::filesystem::temp_directory_path() /
             std::filesystem::path("graben_commission_XXXXXX")) {
    std::string name = path.string();
    assert_non_null(mkdtemp(name.data()));
    path = name;
  }
  ~Folder() { std::filesystem::remove_all(path); }
  [[nodiscard]] std::filesystem::path file(const std::string& text) const {
    const std::filesystem::path file = path / "file";
    std::ofstream(file) << text;
    return file;
  }
  std::filesystem::path path;
};

}  // namespace graben::test
