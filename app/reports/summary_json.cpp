// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "app/machines/task_text.hpp"
#include "app/reports/page_setup.hpp"
#include "app/reports/report_file.hpp"
#include "app/reports/run_reports.hpp"

namespace graben::reports {
namespace {

using nlohmann::ordered_json;

ordered_json value_json(const runs::FigureValue& figure) {
  if (!std::isfinite(figure.value)) {
    return nullptr;
  }
  return figure.info->unit.is_whole ? ordered_json(std::lround(figure.value))
                                    : ordered_json(figure.value);
}

ordered_json known(double value) {
  return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

/// A figure that the run does not have is null; one of a group is left out.
ordered_json figures_json(const runs::RunFigures& figures) {
  ordered_json all;
  for (const runs::FigureValue& figure : figures.values) {
    const std::string name = figure.info->name;
    const std::size_t dot = name.find('.');
    if (dot == std::string::npos) {
      all[name] = value_json(figure);
    } else if (std::isfinite(figure.value)) {
      all[name.substr(0, dot)][name.substr(dot + 1)] = value_json(figure);
    }
  }
  for (const auto& [name, share] : figures.limit_share) {
    all["limit_share"][name] = share;
  }
  return all;
}

}  // namespace

void write_summary(const std::filesystem::path& file, const runs::RunFigures& figures) {
  write_json(file, figures_json(figures));
}

void write_autodig_summary(const std::filesystem::path& file, const runs::AutodigSummary& summary) {
  ordered_json figures = figures_json(runs::headed_figures(summary));
  figures["steps"] = ordered_json::array();
  for (const runs::StepFigures& step : summary.steps) {
    figures["steps"].push_back({{"step", step.step},
                                {"round", step.round},
                                {"kind", machines::step_name(step.kind)},
                                {"straight", step.straight},
                                {"from_s", step.from_s},
                                {"until_s", step.until_s},
                                {"planned_s", step.planned_s},
                                {"max_error_true_m", step.max_error_true_m},
                                {"max_error_measured_m", step.max_error_measured_m},
                                {"end_error_true_m", known(step.end_error_true_m)},
                                {"end_error_measured_m", known(step.end_error_measured_m)},
                                {"arrived", step.arrived},
                                {"ended_by", machines::until_name(step.ended_by)}});
  }
  figures["built_map"] = ordered_json::array();
  for (const runs::BuiltPlace& place : summary.built.map) {
    figures["built_map"].push_back({{"x_m", rounded(place.at_m[0])},
                                    {"y_m", rounded(place.at_m[1])},
                                    {"off_m", rounded(place.off_m)},
                                    {"firm_m", rounded(place.firm_m)}});
  }
  write_json(file, figures);
}

}  // namespace graben::reports
