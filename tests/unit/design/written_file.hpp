// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A file of a test, gone when the test is over.

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/unit/refusal.hpp"

namespace graben::test {

class WrittenFile {
 public:
  WrittenFile(const std::string& name, const std::string& text)
      : folder_(std::filesystem::temp_directory_path() /
                ("graben_design_" + std::to_string(::getpid()))),
        file_(folder_ / name) {
    std::filesystem::create_directories(folder_);
    std::ofstream(file_) << text;
  }
  ~WrittenFile() { std::filesystem::remove_all(folder_); }
  WrittenFile(const WrittenFile&) = delete;
  WrittenFile& operator=(const WrittenFile&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return file_; }

 private:
  std::filesystem::path folder_;
  std::filesystem::path file_;
};

inline bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace graben::test
