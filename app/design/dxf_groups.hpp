// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A DXF file of text as its groups: a code on one line, its value on the next.

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace graben::design {

/// Begins as a DXF of text does: an empty line or a comment aside, with a section.
[[nodiscard]] bool is_dxf(std::string_view text);

class DxfGroups {
 public:
  /// Throws std::runtime_error if the file can't be read, ProfileError where it is a binary DXF.
  explicit DxfGroups(const std::filesystem::path& file);

  /// Takes the next group; false after the last one. Throws ProfileError with the line where a code
  /// is no whole number, or where the file ends in a group.
  bool next();
  [[nodiscard]] int code() const { return code_; }
  /// Without blanks round it.
  [[nodiscard]] std::string_view value() const { return value_; }
  /// Of the value, from 1.
  [[nodiscard]] std::size_t line() const { return line_; }

  [[noreturn]] void refuse(std::size_t line, const std::string& what) const;

 private:
  /// Nothing is left: false.
  bool take_line(std::string_view& line);

  std::filesystem::path file_;
  std::string text_;
  std::size_t at_ = 0;
  std::size_t line_ = 0;
  int code_ = 0;
  std::string_view value_;
};

}  // namespace graben::design
