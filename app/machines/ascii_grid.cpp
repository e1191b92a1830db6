// SPDX-License-Identifier: Apache-2.0
/// Reads an ESRI ASCII grid: six lines of names and numbers, then heights from north to south.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "app/machines/height_grid.hpp"
#include "app/machines/plain_text.hpp"
#include "app/machines/profile_file.hpp"

namespace graben::machines {
namespace {

constexpr double kMostHeight_m = 1e4;

/// Words of a text, with the line of each.
class Words {
 public:
  Words(const std::filesystem::path& file, const std::string& text) : file_(file), left_(text) {}

  /// Empty: there is no more.
  std::string_view next() {
    std::size_t at = 0;
    for (; at < left_.size() && is_blank(left_[at]); ++at) {
      line_ += left_[at] == '\n' ? 1 : 0;
    }
    std::size_t end = at;
    for (; end < left_.size() && !is_blank(left_[end]); ++end) {
    }
    const std::string_view word = left_.substr(at, end - at);
    left_.remove_prefix(end);
    return word;
  }
  /// The next one where it begins as a name does; it is not taken else.
  std::string name() {
    const std::string_view before = left_;
    const int line = line_;
    std::string word(next());
    if (word.empty() || std::isalpha(static_cast<unsigned char>(word[0])) == 0) {
      left_ = before;
      line_ = line;
      return "";
    }
    std::transform(word.begin(), word.end(), word.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    return word;
  }
  double number(const std::string& what) {
    const std::string_view word = next();
    const std::optional<double> value = finite(word);
    if (!value) {
      refuse(fmt::format("{}: '{}'; allowed: a number", what, word));
    }
    return *value;
  }
  [[noreturn]] void refuse(const std::string& what) const {
    throw ProfileError(file_.string(), {fmt::format("line {}: {}", line_, what)});
  }

 private:
  static bool is_blank(char letter) {
    return letter == ' ' || letter == '\n' || letter == '\t' || letter == '\r';
  }
  static std::optional<double> finite(std::string_view word) {
    double value = 0.0;
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    const bool read = error == std::errc() && stop == end && !word.empty() && std::isfinite(value);
    return read ? std::optional<double>(value) : std::nullopt;
  }

  const std::filesystem::path& file_;
  std::string_view left_;
  int line_ = 1;
};

struct Head {
  std::optional<double> columns, rows, step_m, none;
  std::array<std::optional<double>, 2> corner_m, centre_m;
};

Head read_head(Words& words) {
  Head head;
  for (std::string name = words.name(); !name.empty(); name = words.name()) {
    std::optional<double>* const place = name == "ncols"          ? &head.columns
                                         : name == "nrows"        ? &head.rows
                                         : name == "cellsize"     ? &head.step_m
                                         : name == "nodata_value" ? &head.none
                                         : name == "xllcorner"    ? &head.corner_m[0]
                                         : name == "yllcorner"    ? &head.corner_m[1]
                                         : name == "xllcenter"    ? &head.centre_m[0]
                                         : name == "yllcenter"    ? &head.centre_m[1]
                                                                  : nullptr;
    if (place == nullptr) {
      words.refuse(
          fmt::format("'{}'; allowed in front of the heights: ncols, nrows, xllcorner or "
                      "xllcenter, yllcorner or yllcenter, cellsize, NODATA_value",
                      name));
    }
    if (place->has_value()) {
      words.refuse(fmt::format("'{}' a second time; allowed: once", name));
    }
    *place = words.number(name);
  }
  return head;
}

int count_of(const Words& words, const char* name, const std::optional<double>& value) {
  if (!value || *value != std::floor(*value) || *value < 2.0 ||
      *value > static_cast<double>(kMostCells)) {
    words.refuse(fmt::format("{} {}; allowed: 2 .. {}", name,
                             value ? fmt::format("{}", *value) : "is missing", kMostCells));
  }
  return static_cast<int>(*value);
}

HeightGrid grid_of(const Words& words, const Head& head) {
  HeightGrid grid;
  grid.columns = count_of(words, "ncols", head.columns);
  grid.rows = count_of(words, "nrows", head.rows);
  if (static_cast<std::size_t>(grid.columns) > kMostCells / static_cast<std::size_t>(grid.rows)) {
    words.refuse(
        fmt::format("{} by {} heights; allowed: {} in all; `graben surface` cuts out what "
                    "lies --around a place",
                    grid.columns, grid.rows, kMostCells));
  }
  if (!head.step_m || *head.step_m < kLeastStep_m || *head.step_m > kMostStep_m) {
    words.refuse(fmt::format("cellsize {}; allowed: {} .. {} m",
                             head.step_m ? fmt::format("{} m", *head.step_m) : "is missing",
                             kLeastStep_m, kMostStep_m));
  }
  grid.step_m = *head.step_m;
  for (unsigned axis = 0; axis < 2; ++axis) {
    const bool by_corner = head.corner_m[axis].has_value();
    if (by_corner == head.centre_m[axis].has_value()) {
      words.refuse(
          fmt::format("allowed: one of {0}llcorner and {0}llcenter", axis == 0 ? 'x' : 'y'));
    }
    // A corner is that of the first cell, whose height is in its middle.
    grid.first_m[static_cast<int>(axis)] =
        by_corner ? *head.corner_m[axis] + 0.5 * grid.step_m : *head.centre_m[axis];
  }
  return grid;
}

}  // namespace

HeightGrid read_ascii_grid(const std::filesystem::path& file) {
  const std::string text = plain_text(file, "a design: an ESRI ASCII grid");
  if (text.find_first_not_of(" \t\r\n") != std::string::npos &&
      text[text.find_first_not_of(" \t\r\n")] == '<') {
    throw ProfileError(file.string(), {"is XML; allowed: an ESRI ASCII grid, which `graben surface "
                                       "--design FILE --out NAME.asc` makes of LandXML"});
  }
  Words words(file, text);
  const Head head = read_head(words);
  HeightGrid grid = grid_of(words, head);
  grid.height_m.resize(static_cast<std::size_t>(grid.columns) *
                       static_cast<std::size_t>(grid.rows));
  for (int row = grid.rows - 1; row >= 0; --row) {
    for (int column = 0; column < grid.columns; ++column) {
      const double height_m = words.number("a height");
      const bool none = head.none && height_m == *head.none;
      if (!none && std::abs(height_m) > kMostHeight_m) {
        words.refuse(fmt::format("a height of {} m; allowed: {} .. {} m, or NODATA_value", height_m,
                                 -kMostHeight_m, kMostHeight_m));
      }
      grid.at(column, row) = none ? std::numeric_limits<double>::quiet_NaN() : height_m;
    }
  }
  if (!words.next().empty()) {
    words.refuse(fmt::format("more than {} by {} heights", grid.columns, grid.rows));
  }
  return grid;
}

}  // namespace graben::machines
