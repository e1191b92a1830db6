// SPDX-License-Identifier: Apache-2.0
#include "app/reports/compare/compare_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "app/reports/report_file.hpp"
#include "app/reports/report_parts.hpp"

namespace graben::reports {
namespace {

using nlohmann::json;

/// A curve has no more points than anybody sees; an hour of frames would make a page of 100 MB.
constexpr std::size_t kMostPoints = 20000;

struct Moment {
  double time_s = 0.0;  ///< Of the first log.
};

std::vector<Moment> moments(const runs::RunLog& first) {
  const std::size_t step = 1 + first.status_s.size() / kMostPoints;
  std::vector<Moment> all;
  for (std::size_t i = 0; i < first.status_s.size(); i += step) {
    all.push_back({first.status_s[i]});
  }
  return all;
}

json truth(const runs::RunLog& first, const runs::RunLog& second, const std::vector<Moment>& all) {
  Truth<Moment> lines(all);
  const double shift_s = second.start_s - first.start_s;
  const std::vector<runs::ChannelInfo>& table = runs::channel_table(first.is_dozer);
  for (std::size_t i = 0; i < table.size(); ++i) {
    const runs::ChannelInfo& info = table[i];
    const runs::Channel& a = first.channel[i];
    const runs::Channel& b = second.channel[i];
    if (!info.is_on_page) {
      lines.add(info.plot, info.title, fmt::format("{}, first", info.label), info.unit,
                info.decimals, [&](const Moment& m) { return info.per_si * a.at(m.time_s); });
    }
    lines.add(info.plot, info.title, fmt::format("{}, second", info.label), info.unit,
              info.decimals,
              [&](const Moment& m) { return info.per_si * b.at(m.time_s + shift_s); });
  }
  for (std::size_t i = 0; i < table.size(); ++i) {
    const runs::ChannelInfo& info = table[i];
    const runs::Channel& a = first.channel[i];
    const runs::Channel& b = second.channel[i];
    lines.add(
        fmt::format("difference_{}", info.plot), fmt::format("{}: second less first", info.title),
        info.label, info.unit, info.decimals,
        [&](const Moment& m) { return info.per_si * (b.at(m.time_s + shift_s) - a.at(m.time_s)); });
  }
  json told = lines.json();
  told["note"] = "Second log dashed, from where both became active";
  return told;
}

std::string shown(double value, int decimals) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : "-";
}

json summary(const std::vector<runs::ComparedFigure>& figures) {
  json rows = json::array();
  for (const runs::ComparedFigure& figure : figures) {
    rows.push_back(key_figure(
        figure.text,
        fmt::format("{} | {}", shown(figure.first, figure.decimals),
                    shown(figure.second, figure.decimals)),
        figure.unit,
        std::isfinite(figure.second - figure.first)
            ? fmt::format("difference {:+.{}f}", figure.second - figure.first, figure.decimals)
            : ""));
  }
  return rows;
}

}  // namespace

void write_compare_report(const ReportTarget& target, const std::filesystem::path& first_log,
                          const runs::RunLog& first, const runs::RunLog& second,
                          const std::vector<runs::ComparedFigure>& figures,
                          const std::vector<std::string>& notes, const SetupOptions& options) {
  if (first.is_dozer != second.is_dozer) {
    throw std::runtime_error(fmt::format("{} is of {}, {} of {}: they have nothing to compare",
                                         first.name, first.is_dozer ? "a dozer" : "an excavator",
                                         second.name,
                                         second.is_dozer ? "a dozer" : "an excavator"));
  }
  json run = run_json(
      {"Two runs",
       fmt::format("first {} | second {} | both from where they became active{}{}", first.name,
                   second.name, notes.empty() ? "" : " | ", fmt::join(notes, " | ")),
       summary(figures),
       {}},
      truth(first, second, moments(first)));
  add_log(run, first_log);
  json setup = report_setup(first_log, json::object(), std::move(run));
  setup.update(shared_setup(options));
  write_report(target.file, target.page, setup);
}

}  // namespace graben::reports
