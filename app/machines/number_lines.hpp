// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Text files with numbers in lines: what surveyors and spreadsheets write without any format.

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace graben::machines {

inline constexpr std::size_t kMostColumns = 4;
using LineOfNumbers = std::array<double, kMostColumns>;

/// What the columns of a file are: so many, their names, for messages.
struct Columns {
  std::size_t count = 0;  ///< With `more` at most kMostColumns.
  const char* names = "";
  std::size_t most_lines = 0;
  std::size_t more = 0;  ///< So many may follow; not a number where they are not there.
};

/// A line's numbers; `line` counts from 1. What it returns is wrong with them; empty: nothing.
using TakeNumbers = std::function<std::string(std::size_t line, const LineOfNumbers& numbers)>;

/// Hands on every line of the file: numbers with blanks, tabs, commas or semicolons between them,
/// a decimal point, and finite. Empty lines and what follows a # are skipped. Throws
/// std::runtime_error if the file can't be read, ProfileError with every line that is wrong, up to
/// ten, and where it has more lines than allowed.
void read_number_lines(const std::filesystem::path& file, const Columns& columns,
                       const TakeNumbers& take);

/// The whole file. Throws std::runtime_error, with what is `wanted`, if it can't be read.
[[nodiscard]] std::string file_text(const std::filesystem::path& file, const std::string& wanted);

}  // namespace graben::machines
