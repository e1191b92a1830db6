#include "tests/margins/bounds.hpp"

#include <fmt/format.h>

#include <cmath>

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
    {{Places::kPath, 0.05, 1}, {0.6, 2.0}, {0.015, 0.030}, 0.25},
    {{Places::kPath, 0.05, 0}, {0.6, 2.0}, {0.040, 0.040}, 0.25},
    {{Places::kPath, 0.05, 1}, {0.6, 2.0}, {0.040, 0.040}, 0.22},
    {{Places::kPath, 0.02, 0}, {0.6, 2.0}, {0.020, 0.030}, 0.21},
    {{Places::kPath, 0.02, 1}, {0.6, 1.4}, {0.020, 0.030}, 0.41},
    {{Places::kPath, 0.02, 1}, {2.0, 2.0}, {0.020, 0.030}, 0.05},
    {{Places::kPath, 0.0, 0}, {0.6, 1.4}, {0.030, 0.030}, 0.32},
    {{Places::kPath, 0.0, 0}, {1.0, 1.4}, {0.020, 0.030}, 0.08},
    {{Places::kPath, 0.0, 1}, {0.8, 1.0}, {0.020, 0.030}, 0.36},
    {{Places::kCorners, 0.02, 0}, {0.6, 2.0}, {0.015, 0.030}, 0.05},
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
    {{Places::kPath, 0.0, 0}, 41},     {{Places::kPath, 0.0, 1}, 176},
    {{Places::kCorners, 0.05, 0}, 48}, {{Places::kCorners, 0.05, 1}, 60},
    {{Places::kCorners, 0.02, 1}, 1},  {{Places::kCorners, 0.0, 0}, 61},
    {{Places::kCorners, 0.0, 1}, 189},
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

OfBand of_band(const Table& table) {
  OfBand all;
  for (int oil = 0; oil < kOils; ++oil) {
    for (int lag = 0; lag < kLags; ++lag) {
      if (!in_band(kOil_gpa[oil], kLag_s[lag])) {
        continue;
      }
      const Worst& cell = table.worst[oil][lag];
      const Worst& before = table.worst[all.oil][all.lag];
      all.cells += cell.cells;
      all.unstable += cell.unstable;
      const bool is_worse = cell.unstable > 0 ? cell.spectral_radius > before.spectral_radius
                                              : cell.margin.alpha < before.margin.alpha;
      if (is_worse) {
        all.oil = oil;
        all.lag = lag;
      }
    }
  }
  return all;
}

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

std::string text(const Block& block) {
  return fmt::format("{}, {}, {}",
                     block.places == Places::kPath ? "on the path" : "corners of the strokes",
                     block.speed_mps > 0.0 ? fmt::format("drives at {} m/s", block.speed_mps)
                                           : std::string("at rest"),
                     block.late_cycles > 0 ? fmt::format("{} cycle late", block.late_cycles)
                                           : std::string("in time"));
}

}  // namespace graben::margins
