// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the margins have to be: slightly below what was measured. Where the law has none, that is
/// said too, and may not become more.

#include <functional>
#include <string>
#include <vector>

#include "tests/margins/grid.hpp"

namespace graben::margins {

/// A table, by oil and lag.
struct Table {
  Block block;
  Worst worst[kOils][kLags];
};

/// The design's band: of oil 0.6 to 2 GPa, of lag 15 to 30 ms.
[[nodiscard]] bool in_band(double oil_gpa, double lag_s);

/// Of some cells of a table: whose is the worst, and what is the least alpha.
struct OfCells {
  int cells = 0;
  int unstable = 0;
  int oil = -1;
  int lag = -1;
  double alpha = 0.0;
};
/// Of the cells that have it; there has to be one.
[[nodiscard]] OfCells of_cells(const Table& table,
                               const std::function<bool(double oil_gpa, double lag_s)>& has);
[[nodiscard]] OfCells of_band(const Table& table);

/// A line for each bound that a table misses.
[[nodiscard]] std::vector<std::string> missed(const Table& table);

/// Of each oil within the band's lags, and of the lag beyond, as JSON for the results' tables.
void write_summary(const std::vector<Table>& tables, const std::string& file);

/// 'on the path, drives at 0.05 m/s, 1 cycle late'.
[[nodiscard]] std::string text(const Block& block);

}  // namespace graben::margins
