// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/identify/file/identified_file.hpp"
#include "app/identify/machine/swing_figures.hpp"
#include "app/identify/machine/valve_model.hpp"
#include "app/machines/answer_section.hpp"
#include "app/reports/identify/identify_report.hpp"
#include "app/reports/identify/page_style.hpp"
#include "app/reports/identify/plot.hpp"

namespace graben::reports {
namespace {

using identify::DriveEstimate;
using identify::kAxisTexts;
using identify::kGrid_s;
using identify::kTableOpenings;
using identify::LogStretch;
using identify::SideEstimate;

constexpr double kPlotWidth_px = 460.0;
constexpr double kPlotHeight_px = 260.0;
constexpr double kWide_px = 1100.0;
constexpr double kBand = 1.96;
constexpr double kExcerpt_s = 20.0;
/// One point in so many of a motion is drawn.
constexpr std::size_t kEvery = 2;
/// No curve is drawn with more dots.
constexpr std::size_t kMostDots = 400;

/// Old table: travel to the share of the coefficient.
PlotPoints old_curve(const DriveRow& drive, bool extends) {
  PlotPoints points;
  for (double travel = 0.0; travel <= 1.0 + 1e-9; travel += 0.01) {
    points.emplace_back(travel, std::pow(drive.answer.side(extends).spool_to_duty.inverse(travel),
                                         drive.metering.opening_exponent));
  }
  return points;
}

PlotPoints new_curve(const SideEstimate& side) {
  PlotPoints points;
  for (double travel = 0.0; travel <= 1.0 + 1e-9; travel += 0.01) {
    points.emplace_back(travel, side.coefficient_factor.value * side.curve().area_ratio(travel));
  }
  return points;
}

/// About the curve, by the deviations of the travel at each opening.
PlotPoints band(const DriveRow& drive, const SideEstimate& side) {
  PlotPoints left;
  PlotPoints right;
  for (std::size_t at = 0; at < side.duty.size(); ++at) {
    const double share = side.coefficient_factor.value *
                         std::pow(kTableOpenings[at], drive.metering.opening_exponent);
    const double wide = kBand * side.duty_deviation[at];
    left.emplace_back(side.duty[at] - wide, share);
    right.emplace_back(side.duty[at] + wide, share);
  }
  left.insert(left.end(), right.rbegin(), right.rend());
  return left;
}

std::string curve_plot(const IdentifyReport& report, const DriveRow& drive,
                       const std::vector<identify::CurvePoint>& points, int axis, bool extends) {
  const auto k = static_cast<std::size_t>(axis);
  const SideEstimate& side = report.fit.machine.drive[k].side(extends);
  const std::string name = machines::side_name(axis, extends);
  PlotPoints dots;
  for (const identify::CurvePoint& point : points) {
    if (point.axis == axis && point.extends == extends) {
      dots.emplace_back(point.travel, point.share);
    }
  }
  const std::size_t every = dots.size() / kMostDots + 1;
  PlotPoints fewer;
  for (std::size_t at = 0; at < dots.size(); at += every) {
    fewer.push_back(dots[at]);
  }
  Plot plot(name + ": opening curve", {"spool's travel, of full", 0.0, 1.0},
            {"velocity coefficient, of the old full one", 0.0,
             1.1 * std::max(1.0, side.coefficient_factor.value)},
            kPlotWidth_px, kPlotHeight_px);
  if (!side.duty.empty()) {
    plot.area("band", band(drive, side));
  }
  plot.dots("dot", fewer);
  plot.line("old", old_curve(drive, extends));
  if (side.edge.known) {
    plot.line("new", new_curve(side));
  }
  std::string note = side.driven_most > 0.0
                         ? fmt::format("{} points; driven from {:.0f} to {:.0f} %", dots.size(),
                                       100.0 * side.driven_least, 100.0 * side.driven_most)
                         : std::string("was not driven");
  if (side.dead_time_s.known) {
    note += fmt::format("; dead time {:.0f} ± {:.0f} ms", 1e3 * side.dead_time_s.value,
                        1e3 * side.dead_time_s.deviation);
  }
  return fmt::format("<div><h3>{}</h3>\n{}<p>{}</p></div>\n", name, plot.svg(), note);
}

/// Where an axis goes farthest of what was looked at, kExcerpt_s long.
LogStretch excerpt_of(const std::vector<identify::MachineLog>& logs, std::size_t k) {
  const auto length = static_cast<std::size_t>(kExcerpt_s / kGrid_s);
  LogStretch best;
  double most_m = -1.0;
  for (std::size_t l = 0; l < logs.size(); ++l) {
    for (std::size_t n = 0; n < logs[l].segments.size(); ++n) {
      const std::vector<double>& stroke_m = logs[l].segments[n].axis[k].stroke_m;
      for (std::size_t begin = 0; begin < stroke_m.size(); begin += length / 2) {
        const std::size_t end = std::min(begin + length, stroke_m.size());
        double way_m = 0.0;
        for (std::size_t at = begin + 1; at < end; ++at) {
          way_m += std::abs(stroke_m[at] - stroke_m[at - 1]);
        }
        if (way_m > most_m) {
          most_m = way_m;
          best = {l, n, begin, end};
        }
      }
    }
  }
  return best;
}

using Predicted = std::vector<std::vector<identify::PredictedSegment>>;

std::string motion_plot(const IdentifyReport& report, const Predicted& was, const Predicted& is,
                        std::size_t k) {
  const LogStretch part = excerpt_of(report.logs, k);
  const identify::PredictedAxis& old = was[part.log][part.segment].axis[k];
  const identify::PredictedAxis& now = is[part.log][part.segment].axis[k];
  PlotPoints measured;
  PlotPoints before;
  PlotPoints after;
  double most_mps = 0.05;
  for (std::size_t at = part.begin; at < part.end; at += kEvery) {
    const double time_s = kGrid_s * static_cast<double>(at);
    measured.emplace_back(time_s, now.measured_mps[at]);
    before.emplace_back(time_s, old.predicted_mps[at]);
    after.emplace_back(time_s, now.predicted_mps[at]);
    most_mps =
        std::max({most_mps, std::abs(now.measured_mps[at]), std::abs(now.predicted_mps[at])});
  }
  Plot plot(fmt::format("{}: measured and predicted speed", kAxisTexts[k]),
            {fmt::format("s, of {}", report.logs[part.log].name),
             kGrid_s * static_cast<double>(part.begin), kGrid_s * static_cast<double>(part.end)},
            {"m/s", -1.1 * most_mps, 1.1 * most_mps}, kWide_px, kPlotHeight_px);
  plot.line("old", before);
  plot.line("measured", measured);
  plot.line("new", after);
  return fmt::format("<h3>{}</h3>\n{}", kAxisTexts[k], plot.svg());
}

std::string value_table(const IdentifyReport& report) {
  std::string html =
      "<table>\n<tr><th>key</th><th>before</th><th>now</th><th>deviation</th></tr>\n";
  for (const identify::ValueChange& change : identify::value_changes(report.machine, report.fit)) {
    html += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                        html_escaped(change.key), change.before.empty() ? "-" : change.before,
                        change.after, change.deviation.empty() ? "-" : change.deviation);
  }
  return html + "</table>\n";
}

std::vector<std::string> unexplained(const IdentifyReport& report) {
  std::vector<std::string> items;
  for (std::size_t k = 0; k < kDriveCount; ++k) {
    const identify::AxisScore& axis = report.fit.left_out.axis[k];
    if (axis.speed_mps2 > 0.0) {
      items.push_back(fmt::format("{}: {:.1f} % of its speed, RMS (the old profile: {:.1f} %)",
                                  kAxisTexts[k], 100.0 * axis.share(),
                                  100.0 * report.fit.before.axis[k].share()));
    }
  }
  for (const std::string& sentence : identify::score_sentences(report.fit.left_out)) {
    items.push_back(sentence);
  }
  return items;
}

std::string curves(const IdentifyReport& report, const identify::DriveModel& old) {
  const auto points = identify::curve_points(old, report.logs, report.fit.machine);
  std::string html = "<div class=\"plots\">\n";
  for (int axis = 0; axis < static_cast<int>(old.drives()); ++axis) {
    for (const bool extends : {true, false}) {
      html += curve_plot(report, old.drive[static_cast<std::size_t>(axis)], points, axis, extends);
    }
  }
  return html + "</div>\n";
}

}  // namespace

std::string identify_page(const IdentifyReport& report) {
  const identify::DriveModel old(report.machine.profile);
  const Predicted was = predict_logs(old, report.logs);
  const Predicted is = predict_logs(identify::DriveModel(report.fit.profile), report.logs);
  std::string motion;
  for (std::size_t k = 0; k < old.drives() && k < report.logs.front().segments.front().drives;
       ++k) {
    motion += motion_plot(report, was, is, k);
  }
  const std::string table =
      prediction_table({{"old", &report.fit.before}, {"new", &report.fit.left_out}});
  std::string html = page_head(report.machine.name + ": identified", report.machine.name,
                               "identified from " + report.from);
  html +=
      section("Motion that was left out",
              fmt::format("Predicted from duties, pressures, swash and engine speed alone. {:.0f} "
                          "s of motion judge; the new profile of this table was fitted to the "
                          "other {:.0f} s, the values below to all of it.",
                          report.fit.judged_s, report.fit.fitted_s),
              "<pre tabindex=\"0\" role=\"region\" aria-label=\"Errors of the prediction\">" +
                  html_escaped(table) + "</pre>\n");
  if (const auto swing = identify::swing_sentences(report.fit.machine.swing); !swing.empty()) {
    html +=
        section("The platform", "By its motor's pressures and its acceleration.", listed(swing));
  }
  html += section("Opening curves",
                  "<span class=\"key n\">new</span> with its 95 % band, <span class=\"key "
                  "o\">old</span>, <span class=\"key d\">moments of steady motion</span>.",
                  curves(report, old));
  html += section("Speed, where each drive moved most",
                  "<span class=\"key\">measured</span>, predicted by the <span class=\"key "
                  "n\">new</span> and the <span class=\"key o\">old</span> profile.",
                  motion);
  html += section("Values", fmt::format("All from {}.", html_escaped(report.from)),
                  value_table(report));
  html += section("What remains unexplained",
                  "Of the motion that was left out:", listed(unexplained(report)));
  html += section("What is missing", "What the logs do not say keeps its old value.",
                  report.fit.machine.missing.empty() ? "<p>Nothing.</p>\n"
                                                     : listed(report.fit.machine.missing));
  return html + kPageEnd;
}

}  // namespace graben::reports
