// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A profile's text in which single values are replaced or added, while everything else, comments
/// and order included, stays as its author wrote it.

#include <toml++/toml.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace graben::identify {

/// `text` as a TOML string with its quotes.
[[nodiscard]] std::string toml_quoted(std::string_view text);

class ProfileText {
 public:
  /// Throws std::runtime_error where it is not TOML.
  explicit ProfileText(std::string text);

  /// Gives a key of a section ("valve", "pump[0]", "valve.answer.boom.extend") this value, written
  /// in TOML. A value that is there is replaced in its place. A new key goes to the begin of its
  /// section, a new section to the end of the file. With a comment, a line of its own above the
  /// value; it replaces the one that an earlier call in an earlier file has left there, and has the
  /// value before in it. Throws std::runtime_error where the value cannot be found in the text.
  void set(const std::string& section, const std::string& key, const std::string& value,
           const std::string& comment = "");

  /// With all that has been set.
  [[nodiscard]] std::string text() const;

 private:
  struct Edit {
    std::size_t at = 0;
    std::size_t length = 0;  ///< Of what it takes the place of.
    std::string text;
  };
  struct NewSection {
    std::string name;
    std::string lines;
  };

  [[nodiscard]] std::size_t line_begin(std::size_t line) const { return lines_.at(line - 1); }
  [[nodiscard]] std::size_t offset(const toml::source_position& position) const;
  void replace(const std::string& key, const toml::node& node, const std::string& value,
               const std::string& comment);
  void put_comment(std::size_t line, const std::string& comment);
  void add(const std::string& section, const toml::table& table, const std::string& key,
           const std::string& value, const std::string& comment);
  void add_section(const std::string& section, const std::string& lines);

  std::string text_;
  std::vector<std::size_t> lines_;  ///< Where each begins.
  toml::table root_;
  std::vector<Edit> edits_;
  std::vector<NewSection> sections_;
};

}  // namespace graben::identify
