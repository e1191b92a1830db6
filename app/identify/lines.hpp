// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Lines of a text file, plain or gzip.

#include <cstddef>
#include <memory>
#include <string>

struct gzFile_s;

namespace graben::identify {

class Lines {
 public:
  /// Throws std::runtime_error where the file cannot be read, with what is `wanted` and where that
  /// comes from.
  Lines(const std::string& path, const std::string& wanted);

  /// The next line without its end; false after the last. Throws where the file is cut off or no
  /// text.
  bool next(std::string& line);

  [[nodiscard]] std::size_t number() const { return number_; }
  /// The last one had its end: without it, whoever wrote it may not have come to it.
  [[nodiscard]] bool is_whole() const { return is_whole_; }
  /// "file:line" of the last one, for errors.
  [[nodiscard]] std::string where() const;

 private:
  std::string path_;
  std::unique_ptr<gzFile_s, int (*)(gzFile_s*)> file_;
  std::size_t number_ = 0;
  bool is_whole_ = true;
};

}  // namespace graben::identify
