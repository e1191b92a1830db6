// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "app/runs/assist_run.hpp"

namespace graben::runs {
namespace {

struct AssistDraw {
  AssistOptions options;  ///< With the seed of the machine.
};

AssistDraw assist_draw(std::uint64_t seed) {
  const std::uint64_t place = seed > 0 ? seed - 1 : 0;
  const std::uint64_t cell = place % assist_cells();
  AssistDraw draw;
  draw.options.record = static_cast<LeverRecord>(cell % kLeverRecords.size());
  draw.options.design = static_cast<AssistDesign>(cell / kLeverRecords.size());
  draw.options.seed = place / assist_cells() + 1;
  return draw;
}

double ranked(std::vector<double> values, double share) {
  values.erase(std::remove_if(values.begin(), values.end(), [](double v) { return std::isnan(v); }),
               values.end());
  if (values.empty()) {
    return kAbsent;
  }
  std::sort(values.begin(), values.end());
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  return values.at(std::max<std::size_t>(rank, 1) - 1);
}

/// A line for each design and record: median and 95th percentile of each figure.
std::string cell_table(const CampaignData& data) {
  std::map<std::uint64_t, std::vector<std::vector<double>>> cells;
  const std::size_t figures = assist_kind().columns.size();
  for (const auto& [seed, row] : data.rows) {
    auto& cell = cells[(seed - 1) % assist_cells()];
    cell.resize(figures);
    for (std::size_t i = 0; i < figures; ++i) {
      cell[i].push_back(row.figure[i]);
    }
  }
  std::string text = fmt::format("\n{:<24}", "median / p95");
  for (const FigureInfo* info : assist_kind().columns) {
    text += fmt::format("{:>16}", info->column);
  }
  text += "\n";
  for (const auto& [number, cell] : cells) {
    const AssistOptions of = assist_draw(number + 1).options;
    text += fmt::format("{:<10}{:<14}", kAssistDesigns.at(static_cast<std::size_t>(of.design)),
                        kLeverRecords.at(static_cast<std::size_t>(of.record)));
    for (std::size_t i = 0; i < figures; ++i) {
      const ShownUnit& unit = assist_kind().columns[i]->unit;
      const auto shown = [&](double share) {
        const double value = ranked(cell[i], share);
        return std::isnan(value) ? std::string("-")
                                 : fmt::format("{:.{}f}", value * unit.per_si, unit.decimals);
      };
      text += fmt::format("{:>16}", shown(0.5) + " / " + shown(0.95));
    }
    text += "\n";
  }
  return text;
}

}  // namespace

std::uint64_t assist_cells() { return kLeverRecords.size() * kAssistDesigns.size(); }

const CampaignKind& assist_kind() {
  static const CampaignKind kind = {
      "assist", {"done", "not-finished", "fault"}, columns_of(assist_figures())};
  return kind;
}

CampaignOutcome campaign_assist(const CampaignOptions& options,
                                const machines::SimulatedExcavator& nominal,
                                const std::string& errors, bool marked, const Progress& progress) {
  const auto draw = [&](std::uint64_t seed) {
    AssistOptions run = assist_draw(seed).options;
    run.marked = marked;
    TaskScenario scenario;
    scenario.errors = errors;
    scenario.seed = run.seed;
    const AssistResult result = run_assist(arranged(nominal, scenario), run);
    // What did not come to its end keeps its figures.
    CampaignRow row;
    row.end = static_cast<std::size_t>(result.end);
    for (const Figure<AssistSummary>& figure : assist_figures()) {
      row.figure.push_back(figure.of(result.summary));
    }
    return row;
  };
  CampaignOutcome outcome = run_campaign(
      options, assist_kind(),
      fmt::format("assist {} {:08x}{}, {} cells, {}, errors {}", nominal.name, nominal.hash,
                  nominal.simulated.empty() ? "" : " as " + nominal.simulated, assist_cells(),
                  marked ? "marked" : "no mark", errors),
      draw, progress);
  outcome.table += cell_table(read_campaign(options.summary, assist_kind()));
  return outcome;
}

}  // namespace graben::runs
