// SPDX-License-Identifier: Apache-2.0
#include "app/runs/ground_campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>

#include "app/machines/simulated/soil_kinds.hpp"
#include "app/runs/grade_run.hpp"
#include "app/runs/sample_designs.hpp"

namespace graben::runs {
namespace {

/// Nothing but level ground is no test of ground that resists.
constexpr std::size_t kDesigns = 10;
constexpr std::array<double, 3> kEngine_rpm = {1000.0, 1500.0, 2000.0};

enum class GroundEnd : std::size_t { kDone, kOverCut, kLeft, kHalted, kNotFinished, kFault };

GroundEnd end_of(GradeEnd end, const GradeSummary& summary) {
  if (end != GradeEnd::kDone) {
    return end == GradeEnd::kFault ? GroundEnd::kFault : GroundEnd::kNotFinished;
  }
  if (summary.over_cut_m > kMostOverCut_m) {
    return GroundEnd::kOverCut;
  }
  if (summary.ground_left_m > kMostLeft_m) {
    return GroundEnd::kLeft;
  }
  return summary.halt_s > kMostHalt_s ? GroundEnd::kHalted : GroundEnd::kDone;
}

/// Draws of a soil and a design, by what counts.
struct CellFigures {
  std::vector<double> over_cut_m;
  std::vector<double> left_m;
  std::vector<double> passes;
  std::vector<double> time_s;
  double halt_s = 0.0;
  double deceleration_mps2 = 0.0;
  int missed = 0;
};

double ranked_error(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  return values.at(std::max<std::size_t>(rank, 1) - 1);
}

std::size_t column(const std::string& name) {
  const std::vector<const FigureInfo*>& columns = ground_kind().columns;
  const auto at = std::find_if(columns.begin(), columns.end(),
                               [&](const FigureInfo* info) { return info->column == name; });
  if (at == columns.end()) {
    throw std::logic_error("a figure of the ground has no column " + name);
  }
  return static_cast<std::size_t>(at - columns.begin());
}

std::string ground_table(const CampaignData& data) {
  const std::size_t over_cut = column("over_cut_m");
  const std::size_t left = column("ground_left_m");
  const std::size_t halt = column("halt_s");
  const std::size_t deceleration = column("deceleration_true_mps2");
  const std::size_t passes = column("passes");
  const std::size_t time = column("time_s");
  std::map<std::pair<std::size_t, std::string>, CellFigures> cells;
  for (const auto& [seed, row] : data.rows) {
    const GroundCell cell = ground_draw(seed).cell;
    CellFigures& figures = cells[{cell.design, cell.soil}];
    figures.missed += row.done() ? 0 : 1;
    figures.over_cut_m.push_back(row.figure[over_cut]);
    figures.left_m.push_back(row.figure[left]);
    figures.passes.push_back(row.figure[passes]);
    figures.time_s.push_back(row.figure[time]);
    figures.halt_s = std::max(figures.halt_s, row.figure[halt]);
    figures.deceleration_mps2 = std::max(figures.deceleration_mps2, row.figure[deceleration]);
  }
  std::string text =
      fmt::format("\n{:<28}{:<8}{:>6}{:>7}{:>8}{:>8}{:>8}{:>6}{:>6}{:>8}{:>7}\n", "design", "soil",
                  "draws", "missed", "cut p95", "cut max", "left", "halt", "dec", "passes", "time");
  const std::vector<SampleDesign> designs = sample_designs();
  for (const auto& [of, figures] : cells) {
    text += fmt::format(
        "{:<28}{:<8}{:>6}{:>7}{:>8.1f}{:>8.1f}{:>8.1f}{:>6.2f}{:>6.2f}{:>8.0f}{:>7.0f}\n",
        designs.at(of.first).name, of.second, figures.over_cut_m.size(), figures.missed,
        1e3 * ranked_error(figures.over_cut_m, 0.95), 1e3 * ranked_error(figures.over_cut_m, 1.0),
        1e3 * ranked_error(figures.left_m, 1.0), figures.halt_s, figures.deceleration_mps2,
        ranked_error(figures.passes, 0.5), ranked_error(figures.time_s, 0.5));
  }
  return text + fmt::format(
                    "cut: ground below the design, mm; left: above it, max, mm; halt: "
                    "longest, s; dec: largest deceleration, m/s2; passes and time, s: "
                    "median\nmissed: cut more than {:.0f} mm, left "
                    "more than {:.0f} mm, halted longer than {:.0f} s, or not at its end\n",
                    1e3 * kMostOverCut_m, 1e3 * kMostLeft_m, kMostHalt_s);
}

}  // namespace

std::uint64_t ground_cells() { return machines::kSoilNames.size() * kDesigns * kEngine_rpm.size(); }

GroundDraw ground_draw(std::uint64_t seed) {
  const std::uint64_t place = seed > 0 ? seed - 1 : 0;
  std::uint64_t cell = place % ground_cells();
  GroundDraw draw;
  draw.seed = place / ground_cells() + 1;
  draw.cell.soil = machines::kSoilNames.at(cell % machines::kSoilNames.size());
  cell /= machines::kSoilNames.size();
  draw.cell.design = cell % kDesigns;
  draw.cell.engine_rpm = kEngine_rpm.at(cell / kDesigns);
  return draw;
}

const CampaignKind& ground_kind() {
  // In the order of GroundEnd.
  static const CampaignKind kind = {
      "ground",
      {"done", "over-cut", "ground-left", "halted", "not-finished", "fault"},
      columns_of(grade_figures())};
  return kind;
}

CampaignOutcome campaign_ground(const CampaignOptions& options,
                                const machines::SimulatedDozer& nominal, const Progress& progress) {
  const std::vector<SampleDesign> designs = sample_designs();
  const auto draw = [&](std::uint64_t seed) {
    const GroundDraw drawn = ground_draw(seed);
    const SampleDesign& design = designs.at(drawn.cell.design);
    GradeScenario scenario;
    scenario.errors = "all";
    scenario.soil = drawn.cell.soil;
    scenario.engine_rpm = drawn.cell.engine_rpm;
    const machines::SimulatedDozer machine =
        arranged(machines::with_design(nominal, design.corners, design.rounding_m, design.name),
                 scenario, drawn.seed);
    const GradeResult result = run_grade(machine, {}, [](double, const std::string&) {});
    const GradeSummary summary = summarise(machine, result);
    // What was missed keeps its figures: they are what the campaign is about.
    CampaignRow row = campaign_row(0, figures_of(summary));
    row.end = static_cast<std::size_t>(end_of(result.end, summary));
    return row;
  };
  CampaignOutcome outcome =
      run_campaign(options, ground_kind(),
                   fmt::format("ground {} {:08x}, {} cells, soils and errors drawn", nominal.name,
                               nominal.hash, ground_cells()),
                   draw, progress);
  outcome.table += ground_table(read_campaign(options.summary, ground_kind()));
  return outcome;
}

}  // namespace graben::runs
