// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What all seeds of a row came to, and the table.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tests/faults/row.hpp"

namespace graben::faults {

class RowResult {
 public:
  explicit RowResult(const RowText& row) : row_(row) {}

  /// Adds a trial; what it saw must be among what the row allows.
  void add(std::uint64_t seed, Outcome outcome);

  [[nodiscard]] const RowText& row() const { return row_; }
  /// Seed and reason, a line each.
  [[nodiscard]] const std::vector<std::string>& failures() const { return failures_; }
  [[nodiscard]] std::vector<std::string> cells() const;

 private:
  RowText row_;
  std::map<std::string, int> seen_;
  Outcome worst_;
  std::vector<std::string> failures_;
};

/// The columns' heads, then a line for each row, aligned.
void print_table(const std::vector<RowResult>& results);

}  // namespace graben::faults
