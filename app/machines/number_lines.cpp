// SPDX-License-Identifier: Apache-2.0
#include "app/machines/number_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <limits>
#include <string_view>

#include "app/machines/profile_file.hpp"

namespace graben::machines {
namespace {

constexpr std::size_t kMostErrors = 10;

class NumberLines {
 public:
  /// `text` is all of the file.
  NumberLines(const Columns& columns, const TakeNumbers& take, std::string_view text)
      : columns_(columns), take_(take), cell_(columns.cell), has_point_(has_decimal_point(text)) {}

  /// What is wrong with the line; empty: nothing.
  std::string take_line(std::size_t number, std::string_view line) {
    const std::vector<std::string_view> cells = cells_of(line.substr(0, line.find('#')));
    if (cells.empty()) {
      return "";
    }
    const bool is_first = !any_;
    any_ = true;
    if (is_first && columns_.header && is_header(cells)) {
      header_cells_ = cells.size();
      return columns_.header(cells, cell_);
    }
    return cell_.empty() ? in_order(number, cells) : by_place(number, cells);
  }

 private:
  /// Behind a digit or before one, in any line.
  static bool has_decimal_point(std::string_view text) {
    const auto is_digit = [&](std::size_t at) {
      return at < text.size() && std::isdigit(static_cast<unsigned char>(text[at])) != 0;
    };
    for (std::size_t at = text.find('.'); at != std::string_view::npos;
         at = text.find('.', at + 1)) {
      if (is_digit(at + 1) || (at > 0 && is_digit(at - 1))) {
        return true;
      }
    }
    return false;
  }

  static bool is_header(const std::vector<std::string_view>& cells) {
    const auto is_name = [](std::string_view cell) {
      return !cell.empty() && std::isalpha(static_cast<unsigned char>(cell.front())) != 0;
    };
    return std::any_of(cells.begin(), cells.end(), is_name) &&
           std::none_of(cells.begin(), cells.end(),
                        [](std::string_view cell) { return number_in(cell).has_value(); });
  }

  static LineOfNumbers none() {
    LineOfNumbers numbers{};
    numbers.fill(std::numeric_limits<double>::quiet_NaN());
    return numbers;
  }

  /// Numbers with a decimal comma, and commas between them, are twice as many without any point.
  static std::string comma_hint(const std::vector<std::string_view>& cells, std::size_t most) {
    const bool has_point = std::any_of(cells.begin(), cells.end(), [](std::string_view cell) {
      return cell.find('.') != std::string_view::npos;
    });
    // Only where a comma separates: cells of one line lie that far apart in its text.
    const bool has_comma = cells.size() > 1 && *(cells[0].data() + cells[0].size()) == ',';
    return cells.size() > most && !has_point && has_comma
               ? ", as a decimal comma makes them of fewer; a number has a decimal point"
               : "";
  }

  std::string in_order(std::size_t number, const std::vector<std::string_view>& cells) {
    LineOfNumbers numbers = none();
    const std::size_t most = columns_.count + columns_.more;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const auto value = number_in(cells[i]);
      const bool may_lack = cells[i].empty() && i >= columns_.count;
      if (!value && !may_lack) {
        return fmt::format("{}; allowed: {}", not_a_number(cells[i]), columns_.names);
      }
      if (value && i < most) {
        numbers[i] = *value;
      }
    }
    const std::size_t count = cells.size();
    const std::string allowed = columns_.more > 0 ? fmt::format("{} .. {}", columns_.count, most)
                                                  : std::to_string(columns_.count);
    return count >= columns_.count && count <= most
               ? take_(number, numbers)
               : fmt::format("{} number{}{}; allowed: {}, {}", count, count == 1 ? "" : "s",
                             comma_hint(cells, most), allowed, columns_.names);
  }

  /// Cells beyond those that are named are passed over. But where all are numbers, two for each
  /// that is named, and the whole file has no decimal point, they are halves of numbers.
  [[nodiscard]] bool has_halves(const std::vector<std::string_view>& cells) const {
    const std::size_t told = *std::max_element(cell_.begin(), cell_.end()) + 1;
    const std::size_t named = header_cells_ > 0 ? header_cells_ : told;
    return !has_point_ && cells.size() >= named + cell_.size() && !comma_hint(cells, 1).empty() &&
           std::all_of(cells.begin(), cells.end(),
                       [](std::string_view cell) { return number_in(cell).has_value(); });
  }

  std::string by_place(std::size_t number, const std::vector<std::string_view>& cells) {
    if (has_halves(cells)) {
      return fmt::format("{} numbers{}; allowed: {}", cells.size(), comma_hint(cells, 1),
                         columns_.names);
    }
    LineOfNumbers numbers = none();
    for (std::size_t i = 0; i < cell_.size(); ++i) {
      const std::string_view cell = cell_[i] < cells.size() ? cells[cell_[i]] : std::string_view();
      const auto value = number_in(cell);
      if (!value) {
        return fmt::format("column {}: {}; allowed: {}", cell_[i] + 1, not_a_number(cell),
                           columns_.names);
      }
      numbers[i] = *value;
    }
    return take_(number, numbers);
  }

  const Columns& columns_;
  const TakeNumbers& take_;
  CellOfNumber cell_;
  std::size_t header_cells_ = 0;  ///< Of the first line, where that has names.
  bool has_point_;                ///< Somewhere in the file: then no comma is one.
  bool any_ = false;
};

}  // namespace

void read_number_lines(const std::filesystem::path& file, const Columns& columns,
                       const TakeNumbers& take) {
  const std::string text = plain_text(file, fmt::format("lines of {}", columns.names));
  NumberLines lines(columns, take, text);
  std::vector<std::string> errors;
  std::size_t number = 0;
  for (std::size_t at = 0; at < text.size() && errors.size() < kMostErrors;) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    ++number;
    if (number > columns.most_lines) {
      errors.push_back(
          fmt::format("line {}: allowed: at most {} lines", number, columns.most_lines));
      break;
    }
    const std::string wrong = lines.take_line(number, std::string_view(text).substr(at, end - at));
    if (!wrong.empty()) {
      errors.push_back(fmt::format("line {}: {}", number, wrong));
    }
    at = end + 1;
  }
  if (!errors.empty()) {
    throw ProfileError(file.string(), errors);
  }
}

}  // namespace graben::machines
