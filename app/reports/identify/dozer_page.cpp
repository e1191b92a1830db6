// SPDX-License-Identifier: Apache-2.0
#include "app/reports/identify/dozer_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/commission/dozer_plan.hpp"
#include "app/reports/identify/page_style.hpp"
#include "app/reports/identify/plot.hpp"

namespace graben::reports {
namespace {

using commission::kDozerDrives;

constexpr double kPlotWidth_px = 460.0;
constexpr double kPlotHeight_px = 260.0;
constexpr double kStep = 0.01;
/// Longer values are tables, which the curves show.
constexpr std::size_t kLongest = 60;

PlotPoints speeds(const DozerProfile& profile, std::size_t drive, double sign) {
  PlotPoints points;
  for (double duty = 0.0; duty <= 1.0 + 1e-9; duty += kStep) {
    points.emplace_back(duty, 1e3 * std::abs(identify::steady_blade_mps(profile, drive, sign * duty,
                                                                        profile.hst.engine_radps)));
  }
  return points;
}

double most_of(const PlotPoints& points) {
  double most = 0.0;
  for (const auto& [duty, speed] : points) {
    most = std::max(most, speed);
  }
  return most;
}

std::string side_plot(const DozerReport& report, std::size_t drive, bool extends) {
  const identify::BladeSideEstimate& side = report.estimate.blade[drive].side(extends);
  const double sign = extends ? 1.0 : -1.0;
  const PlotPoints old = speeds(report.machine.profile, drive, sign);
  const PlotPoints now = speeds(report.found, drive, sign);
  const std::string name =
      fmt::format("{}, {}", kDozerDrives[drive], extends ? "extending" : "retracting");
  Plot plot(name + ": speed over duty", {"duty, of full", 0.0, 1.0},
            {"mm/s, alone on the pump", 0.0, 1.1 * std::max({most_of(old), most_of(now), 1.0})},
            kPlotWidth_px, kPlotHeight_px);
  plot.line("old", old);
  if (side.known()) {
    plot.line("new", now);
  }
  const std::string note = side.known()
                               ? fmt::format("driven from {:.0f} to {:.0f} %",
                                             100.0 * side.driven_least, 100.0 * side.driven_most)
                               : std::string("was not driven");
  return fmt::format("<div><h3>{}</h3>\n{}<p>{}</p></div>\n", name, plot.svg(), note);
}

std::string curves(const DozerReport& report) {
  std::string html = "<div class=\"plots\">\n";
  for (std::size_t drive = 0; drive < (report.machine.profile.tilt.present ? 2U : 1U); ++drive) {
    html += side_plot(report, drive, true) + side_plot(report, drive, false);
  }
  return html + "</div>\n";
}

std::string share_text(double score) {
  return score < 0.0 ? std::string("was not driven") : fmt::format("{:.1f} %", 100.0 * score);
}

std::string score_table(const DozerReport& report) {
  std::string html = "<table>\n<tr><th>drive</th><th>old</th><th>new</th></tr>\n";
  for (std::size_t at = 0; at < std::size(kDozerDrives); ++at) {
    html += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td></tr>\n", kDozerDrives[at],
                        share_text(report.before[at]), share_text(report.after[at]));
  }
  return html + "</table>\n";
}

std::string value_table(const DozerReport& report) {
  std::string html =
      "<table>\n<tr><th>key</th><th>before</th><th>now</th><th>deviation</th></tr>\n";
  const auto shown = [](const std::string& value) {
    return value.empty()
               ? std::string("-")
               : (value.size() > kLongest ? std::string("a table, above") : html_escaped(value));
  };
  for (const identify::DozerChange& change : report.changes) {
    html += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                        html_escaped(change.path()), shown(change.before), shown(change.after),
                        shown(change.deviation));
  }
  return html + "</table>\n";
}

}  // namespace

std::string dozer_page(const DozerReport& report) {
  std::string html = page_head(report.machine.name + ": identified", report.machine.name,
                               "identified from " + report.from);
  html +=
      section("Motion",
              "What the speeds that the profiles predict from duties and displacements are off, "
              "RMS over the speed's own, on the same logs.",
              score_table(report));
  html += section("Blade",
                  "<span class=\"key n\">new</span>, <span class=\"key o\">old</span>, at the "
                  "profile's engine speed.",
                  curves(report));
  html += section("Beside the keys", "Found, and no key of the profile has it.",
                  listed(identify::dozer_sentences(report.estimate)));
  html += section("Values", fmt::format("All from {}.", html_escaped(report.from)),
                  value_table(report));
  html += section(
      "What is missing", "What the logs do not say keeps its old value.",
      report.estimate.missing.empty() ? "<p>Nothing.</p>\n" : listed(report.estimate.missing));
  return html + kPageEnd;
}

}  // namespace graben::reports
