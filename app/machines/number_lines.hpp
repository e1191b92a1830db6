// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Text files with numbers in lines: what surveyors and spreadsheets write without any format.

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "app/machines/plain_text.hpp"

namespace graben::machines {

inline constexpr std::size_t kMostColumns = 4;
using LineOfNumbers = std::array<double, kMostColumns>;

/// Which cell of a line each number is in, from 0.
using CellOfNumber = std::vector<std::size_t>;

/// What the columns of a file are: so many, their names, for messages.
struct Columns {
  std::size_t count = 0;  ///< With `more` at most kMostColumns.
  const char* names = "";
  std::size_t most_lines = 0;
  std::size_t more = 0;  ///< So many may follow; not a number where they are not there.
  /// Of `count` numbers, where they are not the first cells in order; other cells are passed over.
  CellOfNumber cell = {};
  /// Told the first line, where none of its cells is a number: puts where they are into `cell`, or
  /// leaves it empty for the usual order. What it returns is wrong; empty: nothing. None: there may
  /// be no such line.
  std::function<std::string(const std::vector<std::string_view>& words, CellOfNumber& cell)>
      header = {};
};

/// A line's numbers; `line` counts from 1. What it returns is wrong with them; empty: nothing.
using TakeNumbers = std::function<std::string(std::size_t line, const LineOfNumbers& numbers)>;

/// Hands on every line of the file: cells (cells_of) with finite numbers, a decimal point, a plus
/// or not. An empty cell is one, but for those that end a line; lines of none and what follows a #
/// are skipped. Throws std::runtime_error if the file can't be read, ProfileError with every line
/// that is wrong, up to ten, and where it has more lines than allowed.
void read_number_lines(const std::filesystem::path& file, const Columns& columns,
                       const TakeNumbers& take);

}  // namespace graben::machines
