// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A file that a test needs for a while.

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace graben::test {

class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& content) {
    std::string name = (std::filesystem::temp_directory_path() / "graben_scope_XXXXXX").string();
    close(mkstemp(name.data()));
    path_ = name;
    write(content);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }

  void write(const std::string& content) const {
    std::ofstream(path_, std::ios::binary | std::ios::trunc) << content;
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace graben::test
