// SPDX-License-Identifier: Apache-2.0
#include "app/reports/report_parts.hpp"

#include <fmt/format.h>

#include "app/reports/page_setup.hpp"
#include "app/reports/report_file.hpp"

namespace graben::reports {
namespace {

/// Bit rate of a real bus in the simulated one's place.
constexpr int kBitrate_bps = 500000;

}  // namespace

nlohmann::json key_figure(const std::string& label, const std::string& value,
                          const std::string& unit, const std::string& note) {
  return {{"label", label}, {"value", value}, {"unit", unit}, {"note", note}};
}

RunText run_text(const std::string& title, const std::string& subtitle,
                 const runs::RunFigures& figures) {
  RunText text = {title, subtitle, nlohmann::json::array(), figures.limit_share};
  for (const runs::FigureValue& figure : figures.values) {
    if (std::isfinite(figure.value)) {
      text.summary.push_back(
          key_figure(figure.info->text, runs::shown_value(figure), figure.info->unit.text, ""));
    }
  }
  return text;
}

nlohmann::json plotted(double value, int decimals) {
  if (!std::isfinite(value)) {
    return nullptr;
  }
  const double scale = std::pow(10.0, decimals);
  return std::round(value * scale) / scale;
}

nlohmann::json run_json(const RunText& text, nlohmann::json truth) {
  nlohmann::json shares = nlohmann::json::array();
  for (const auto& [name, share] : text.limit_share) {
    shares.push_back({{"name", name}, {"share", share}});
  }
  return {{"title", text.title},
          {"subtitle", text.subtitle},
          {"summary", text.summary},
          {"limits_share", std::move(shares)},
          {"truth", std::move(truth)}};
}

void add_log(nlohmann::json& run, const std::filesystem::path& log_file) {
  run["log"] = std::filesystem::is_regular_file(log_file) ? packed_file(log_file) : packed("");
}

nlohmann::json report_setup(const std::filesystem::path& log_file, nlohmann::json machine,
                            nlohmann::json run) {
  return {{"source",
           {{"mode", "report"}, {"name", log_file.filename().string()}, {"bitrate", kBitrate_bps}}},
          {"machines", nlohmann::json::array({std::move(machine)})},
          {"words", text_json()},
          {"version", GRABEN_VERSION},
          {"run", std::move(run)}};
}

}  // namespace graben::reports
