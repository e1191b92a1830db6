// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A LandXML file: its elements, with their lines for messages, and its unit of length.

#include <Eigen/Core>
#include <charconv>
#include <filesystem>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace graben::design {

/// The words of an element, between blanks; one more than `most` ends it. A comment or another
/// element may stand between them: then its text is put together in `room`, which the words need.
[[nodiscard]] std::vector<std::string_view> words_of(const pugi::xml_node& node, std::size_t most,
                                                     std::string& room);

/// As XML Schema writes numbers: a plus may stand before one.
template <class Number>
[[nodiscard]] std::optional<Number> number_of(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') {
    word.remove_prefix(1);
  }
  Number number{};
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, number);
  return error == std::errc() && stop == end ? std::optional<Number>(number) : std::nullopt;
}

class LandXmlFile {
 public:
  /// Throws std::runtime_error if it can't be read, ProfileError with the line if it is no LandXML
  /// or has no unit of length.
  explicit LandXmlFile(const std::filesystem::path& file);

  [[nodiscard]] pugi::xml_node root() const { return document_.document_element(); }
  [[nodiscard]] double metres() const { return metres_; }
  /// What it has of these, in all groups of that name: by its name, by its number among them ("#2")
  /// or by its state ("state=proposed"); unless told, the only one. Throws ProfileError.
  [[nodiscard]] pugi::xml_node chosen(const char* group, const char* element,
                                      const std::string& name, const char* option) const;
  /// Coordinates north, east and as many as `count` in metres; what is wrong is noted, and none
  /// come.
  [[nodiscard]] std::optional<Eigen::Vector3d> north_east_up_m(const pugi::xml_node& node,
                                                               std::size_t count);

  /// "line 12, <P id="7">"
  [[nodiscard]] std::string place(const pugi::xml_node& node) const;
  /// Ten of them are thrown.
  void note(const pugi::xml_node& node, const std::string& what);
  [[noreturn]] void refuse(const pugi::xml_node& node, const std::string& what) const;
  void throw_errors() const;
  /// How many there were: of what was only looked at.
  std::size_t forget_notes() {
    const std::size_t count = errors_.size();
    errors_.clear();
    return count;
  }

 private:
  [[nodiscard]] std::size_t line_at(std::ptrdiff_t offset) const;
  void read_unit();
  void refuse_mirrored() const;

  std::filesystem::path file_;
  std::string text_;
  pugi::xml_document document_;
  double metres_ = 1.0;
  std::vector<std::string> errors_;
};

}  // namespace graben::design
