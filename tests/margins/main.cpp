// SPDX-License-Identifier: Apache-2.0
/// Margins of the oil's law over pose and band: prints the tables, and fails where they miss their
/// bounds.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <exception>

#include "tests/margins/bounds.hpp"

namespace {

using namespace graben;
using namespace graben::margins;

constexpr double kDegPerRad = 57.29577951308232;
constexpr double kSpeed_mps[] = {0.05, 0.02, 0.0};

Table table_of(const Grid& grid, const Block& block) {
  Table table;
  table.block = block;
  for (int oil = 0; oil < kOils; ++oil) {
    for (int lag = 0; lag < kLags; ++lag) {
      table.worst[oil][lag] = grid.worst(block, kOil_gpa[oil], kLag_s[lag]);
    }
  }
  return table;
}

std::string shown(const Worst& worst) {
  return worst.unstable > 0 ? fmt::format("{} of {} unstable", worst.unstable, worst.cells)
                            : fmt::format("{:.1f} dB / {:.0f} deg", gain_db(worst.margin.alpha),
                                          phase_deg(worst.margin.alpha));
}

void print_worst(const Table& table, int oil, int lag) {
  const Worst& worst = table.worst[oil][lag];
  fmt::print("  {} GPa, {:.0f} ms: {} at {}, mass {}", kOil_gpa[oil], 1e3 * kLag_s[lag],
             shown(worst), worst.place, worst.mass_ratio);
  if (worst.unstable > 0) {
    fmt::print(", grows by {:.2f}/s\n", -decay_ps(worst.spectral_radius));
    return;
  }
  fmt::print(
      ", {}, {:.1f} Hz; fades by {:.1f}/s at least; gain alone x {:.1f}, phase alone {:.0f} deg\n",
      worst.is_arm ? "arm" : "boom", worst.margin.at_hz, decay_ps(worst.spectral_radius),
      worst.gain_up, kDegPerRad * worst.phase_rad);
}

void print(const Table& table) {
  fmt::print("\n{}\n{:10}", text(table.block), "oil \\ lag");
  for (const double lag_s : kLag_s) {
    fmt::print("{:>22}", fmt::format("{:.0f} ms", 1e3 * lag_s));
  }
  for (int oil = 0; oil < kOils; ++oil) {
    fmt::print("\n{:<10}", fmt::format("{} GPa", kOil_gpa[oil]));
    for (int lag = 0; lag < kLags; ++lag) {
      fmt::print("{:>22}", shown(table.worst[oil][lag]));
    }
  }
  fmt::print("\n");
}

/// The worst of each oil, of each lag within the band's oils, and of the whole band.
void print_places(const Table& table) {
  for (const double oil_gpa : kOil_gpa) {
    const OfCells of = of_cells(table, [&](double oil, double) { return oil == oil_gpa; });
    print_worst(table, of.oil, of.lag);
  }
  for (const double lag_s : kLag_s) {
    const OfCells of = of_cells(table, [&](double oil_gpa, double lag) {
      return lag == lag_s && oil_gpa <= kOil_gpa[kOils - 2];
    });
    print_worst(table, of.oil, of.lag);
  }
  const OfCells band = of_band(table);
  fmt::print("band: {} of {} unstable, alpha {:.2f}\n", band.unstable, band.cells, band.alpha);
}

std::vector<Block> blocks(bool only_first) {
  std::vector<Block> all;
  for (const Places places : {Places::kPath, Places::kCorners}) {
    for (const double speed_mps : kSpeed_mps) {
      for (const int late_cycles : {0, 1}) {
        all.push_back({places, speed_mps, late_cycles});
      }
    }
  }
  all.resize(only_first ? 1 : all.size());
  return all;
}

int run(const Changed& changed, bool only_first, const std::string& summary) {
  const Grid grid(changed);
  std::vector<std::string> problems;
  std::vector<Table> tables;
  for (const Block& block : blocks(only_first)) {
    tables.push_back(table_of(grid, block));
    print(tables.back());
    print_places(tables.back());
    const std::vector<std::string> lines = missed(tables.back());
    problems.insert(problems.end(), lines.begin(), lines.end());
  }
  if (!summary.empty()) {
    write_summary(tables, summary);
  }
  fmt::print("\n");
  for (const std::string& line : problems) {
    fmt::print("missed: {}\n", line);
  }
  fmt::print("margins: {} bounds missed\n", problems.size());
  return problems.empty() ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app("Margins of the oil's law over pose and band");
  Changed changed;
  bool only_first = false;
  std::string summary;
  app.add_option("--assumed", changed.assumed_gpa, "GPa, instead of what the profiles assume");
  app.add_option("--gain", changed.gain, "Factor on all that is asked for");
  app.add_option("--lead", changed.lead_s,
                 "s, instead of the spools' lag that commands lead through");
  app.add_option("--lag", changed.design.lag_s, "s, OilDesign::lag_s");
  app.add_option("--travel", changed.design.travel_ps, "1/s, OilDesign::travel_ps");
  app.add_option("--speed", changed.design.speed_s, "s, OilDesign::speed_s");
  app.add_option("--balance", changed.design.balance, "OilDesign::balance");
  app.add_option("--load", changed.design.load_m2ps, "m2/s, OilDesign::load_m2ps");
  app.add_option("--flow", changed.design.flow_m2ps3, "m2/s3, OilDesign::flow_m2ps3");
  app.add_option("--travel-noise", changed.design.travel_noise_m, "m");
  app.add_option("--pressure-noise", changed.design.pressure_noise_m, "m");
  app.add_flag("--first", only_first, "Only the first table");
  app.add_option("--summary", summary, "Write the worst of each oil and lag to this JSON file");
  CLI11_PARSE(app, argc, argv);
  return run(changed, only_first, summary);
} catch (const std::exception& error) {
  fmt::print("margins: {}\n", error.what());
  return EXIT_FAILURE;
}
