// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "app/runs/assist_run.hpp"

namespace graben::runs {
namespace {

/// With the seed of the machine.
AssistOptions assist_draw(const AssistTrial& trial, std::uint64_t seed) {
  const std::uint64_t place = seed > 0 ? seed - 1 : 0;
  const std::uint64_t cell = place % trial.cells();
  const std::size_t design = cell / kLeverRecords.size();
  AssistOptions options;
  options.record = static_cast<LeverRecord>(cell % kLeverRecords.size());
  if (trial.grounds.empty()) {
    options.design = static_cast<AssistDesign>(design);
  } else {
    options.ground = trial.grounds.at(design);
  }
  options.marked = trial.marked;
  options.seed = place / trial.cells() + 1;
  return options;
}

std::string design_name(const AssistOptions& of) {
  return of.ground != nullptr ? of.ground->name
                              : kAssistDesigns.at(static_cast<std::size_t>(of.design));
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
std::string cell_table(const CampaignData& data, const AssistTrial& trial) {
  std::map<std::uint64_t, std::vector<std::vector<double>>> cells;
  const std::size_t figures = assist_kind().columns.size();
  for (const auto& [seed, row] : data.rows) {
    auto& cell = cells[(seed - 1) % trial.cells()];
    cell.resize(figures);
    for (std::size_t i = 0; i < figures; ++i) {
      cell[i].push_back(row.figure[i]);
    }
  }
  std::string text = fmt::format("\n{:<26}", "median / p95");
  for (const FigureInfo* info : assist_kind().columns) {
    text += fmt::format("{:>16}", info->column);
  }
  text += "\n";
  for (const auto& [number, cell] : cells) {
    const AssistOptions of = assist_draw(trial, number + 1);
    text += fmt::format("{:<13} {:<12}", design_name(of),
                        kLeverRecords.at(static_cast<std::size_t>(of.record)));
    for (std::size_t i = 0; i < figures; ++i) {
      const ShownUnit& unit = assist_kind().columns[i]->unit;
      const auto& values = cell[i];
      const auto shown = [&](double share) {
        const double value = ranked(values, share);
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

const CampaignKind& assist_kind() {
  static const CampaignKind kind = {
      "assist", {"done", "not-finished", "fault"}, columns_of(assist_figures())};
  return kind;
}

CampaignOutcome campaign_assist(const CampaignOptions& options,
                                const machines::SimulatedExcavator& nominal,
                                const AssistTrial& trial, const Progress& progress) {
  TaskScenario tried;
  tried.errors = trial.errors;
  tried.found = trial.found;
  tried.imus = trial.imus;
  const auto draw = [&](std::uint64_t seed) {
    const AssistOptions run = assist_draw(trial, seed);
    TaskScenario scenario = tried;
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
  std::string grounds;
  for (const auto& ground : trial.grounds) {
    grounds += fmt::format(", {} {:08x}", ground->name, ground->surface->hash);
  }
  CampaignOutcome outcome = run_campaign(
      options, assist_kind(),
      fmt::format("assist {} {:08x}{}, {} cells, {}, {}{}", nominal.name, nominal.hash,
                  nominal.simulated.empty() ? "" : " as " + nominal.simulated, trial.cells(),
                  trial.marked ? "marked" : "no mark", machine_text(tried), grounds),
      draw, progress);
  outcome.table += cell_table(read_campaign(options.summary, assist_kind()), trial);
  return outcome;
}

}  // namespace graben::runs
