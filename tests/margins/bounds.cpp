// SPDX-License-Identifier: Apache-2.0
#include "tests/margins/bounds.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

namespace graben::margins {
namespace {

constexpr double kSoftest_gpa = 0.6;
constexpr double kStiffest_gpa = 2.0;
constexpr double kFastest_s = 0.015;
constexpr double kSlowest_s = 0.030;
/// Of numbers that are written in a table.
constexpr double kSame = 1e-9;

/// Of the cells of a block within oil and lag: none is unstable, and alpha is at least that.
struct Bound {
  Block block;
  double oil_gpa[2];
  double lag_s[2];
  double least_alpha;
};
constexpr Bound kBounds[] = {
    {{Places::kPath, 0.05, 0}, {0.6, 2.0}, {0.015, 0.030}, 0.24},
    {{Places::kPath, 0.05, 1}, {0.6, 2.0}, {0.015, 0.030}, 0.24},
    {{Places::kPath, 0.05, 0}, {0.6, 2.0}, {0.040, 0.040}, 0.24},
    {{Places::kPath, 0.05, 1}, {0.6, 2.0}, {0.040, 0.040}, 0.21},
    {{Places::kPath, 0.02, 0}, {0.6, 2.0}, {0.020, 0.030}, 0.21},
    {{Places::kPath, 0.02, 1}, {0.6, 1.4}, {0.020, 0.030}, 0.41},
    {{Places::kPath, 0.02, 1}, {2.0, 2.0}, {0.020, 0.030}, 0.02},
    {{Places::kPath, 0.0, 0}, {0.6, 1.4}, {0.030, 0.030}, 0.28},
    {{Places::kPath, 0.0, 0}, {1.0, 1.4}, {0.020, 0.030}, 0.08},
    {{Places::kPath, 0.0, 1}, {0.8, 1.0}, {0.020, 0.030}, 0.36},
    {{Places::kCorners, 0.02, 0}, {0.6, 2.0}, {0.015, 0.030}, 0.01},
    {{Places::kCorners, 0.02, 1}, {0.6, 1.4}, {0.015, 0.030}, 0.17},
};

/// So many cells of a block may be unstable within the band: what rounding may add to the measured.
struct Allowed {
  Block block;
  int unstable;
};
constexpr int kRounding = 2;
constexpr Allowed kAllowed[] = {
    {{Places::kPath, 0.02, 0}, 7},     {{Places::kPath, 0.02, 1}, 1},
    {{Places::kPath, 0.0, 0}, 41},     {{Places::kPath, 0.0, 1}, 186},
    {{Places::kCorners, 0.05, 0}, 51}, {{Places::kCorners, 0.05, 1}, 64},
    {{Places::kCorners, 0.02, 1}, 1},  {{Places::kCorners, 0.0, 0}, 81},
    {{Places::kCorners, 0.0, 1}, 200},
};

bool same(const Block& a, const Block& b) {
  return a.places == b.places && a.late_cycles == b.late_cycles &&
         std::abs(a.speed_mps - b.speed_mps) < kSame;
}

bool within(const double (&range)[2], double value) {
  return value > range[0] - kSame && value < range[1] + kSame;
}

}  // namespace

bool in_band(double oil_gpa, double lag_s) {
  return within({kSoftest_gpa, kStiffest_gpa}, oil_gpa) && within({kFastest_s, kSlowest_s}, lag_s);
}

OfCells of_cells(const Table& table, const std::function<bool(double, double)>& has) {
  OfCells all;
  for (int oil = 0; oil < kOils; ++oil) {
    for (int lag = 0; lag < kLags; ++lag) {
      if (!has(kOil_gpa[oil], kLag_s[lag])) {
        continue;
      }
      const Worst& cell = table.worst[oil][lag];
      const bool is_first = all.cells == 0;
      all.cells += cell.cells;
      all.unstable += cell.unstable;
      if (is_first || is_worse(cell, table.worst[all.oil][all.lag])) {
        all.oil = oil;
        all.lag = lag;
      }
    }
  }
  all.alpha = table.worst[all.oil][all.lag].margin.alpha;
  return all;
}

OfCells of_band(const Table& table) { return of_cells(table, in_band); }

std::vector<std::string> missed(const Table& table) {
  std::vector<std::string> lines;
  for (const Bound& bound : kBounds) {
    if (!same(bound.block, table.block)) {
      continue;
    }
    for (int oil = 0; oil < kOils; ++oil) {
      for (int lag = 0; lag < kLags; ++lag) {
        const Worst& worst = table.worst[oil][lag];
        if (within(bound.oil_gpa, kOil_gpa[oil]) && within(bound.lag_s, kLag_s[lag]) &&
            worst.margin.alpha < bound.least_alpha) {
          lines.push_back(
              fmt::format("{}, {} GPa, {:.0f} ms: alpha {:.2f}, {} unstable; at least {}",
                          text(table.block), kOil_gpa[oil], 1e3 * kLag_s[lag], worst.margin.alpha,
                          worst.unstable, bound.least_alpha));
        }
      }
    }
  }
  for (const Allowed& allowed : kAllowed) {
    const int unstable = of_band(table).unstable;
    if (same(allowed.block, table.block) && unstable > allowed.unstable + kRounding) {
      lines.push_back(fmt::format("{}: {} cells of the band are unstable; at most {}",
                                  text(table.block), unstable, allowed.unstable));
    }
  }
  return lines;
}

void write_summary(const std::vector<Table>& tables, const std::string& file) {
  nlohmann::json all;
  for (const Table& table : tables) {
    const auto add = [&](const std::string& name, const OfCells& cells) {
      all[text(table.block)][name] = {{"gain_db", gain_db(cells.alpha)},
                                      {"phase_deg", phase_deg(cells.alpha)},
                                      {"unstable", cells.unstable},
                                      {"cells", cells.cells}};
    };
    for (const double oil_gpa : kOil_gpa) {
      add(fmt::format("{} GPa", oil_gpa), of_cells(table, [&](double oil, double lag_s) {
            return oil == oil_gpa && within({kFastest_s, kSlowest_s}, lag_s);
          }));
    }
    for (const double lag_s : kLag_s) {
      add(fmt::format("{:.0f} ms", 1e3 * lag_s), of_cells(table, [&](double oil_gpa, double lag) {
            return lag == lag_s && within({kSoftest_gpa, kStiffest_gpa}, oil_gpa);
          }));
    }
    add("band", of_band(table));
  }
  std::ofstream(file) << all.dump(1) << '\n';
}

std::string text(const Block& block) {
  return fmt::format("{}, {}, {}",
                     block.places == Places::kPath ? "on the path" : "corners of the strokes",
                     block.speed_mps > 0.0 ? fmt::format("drives at {} m/s", block.speed_mps)
                                           : std::string("at rest"),
                     block.late_cycles > 0 ? fmt::format("{} cycle late", block.late_cycles)
                                           : std::string("in time"));
}

}  // namespace graben::margins
