#pragma once
/// What the margins have to be: slightly below what was measured. Where the law has none, that is
/// said too, and may not become more.

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

/// The worst of a table within the band; `oil` and `lag` say where.
struct OfBand {
  int cells = 0;
  int unstable = 0;
  int oil = 0;
  int lag = 0;
};
[[nodiscard]] OfBand of_band(const Table& table);

/// A line for each bound that a table misses.
[[nodiscard]] std::vector<std::string> missed(const Table& table);

/// 'on the path, drives at 0.05 m/s, 1 cycle late'.
[[nodiscard]] std::string text(const Block& block);

}  // namespace graben::margins
