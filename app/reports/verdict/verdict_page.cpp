// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/reports/identify/page_style.hpp"
#include "app/reports/identify/plot.hpp"
#include "app/reports/verdict/verdict_report.hpp"

namespace graben::reports {
namespace {

using identify::CurveFit;
using identify::DriveTrack;
using identify::DriveVerdict;
using identify::Tracks;
using identify::Verdict;

constexpr double kPlotWidth_px = 460.0;
constexpr double kPlotHeight_px = 260.0;
constexpr double kWide_px = 1100.0;
constexpr double kExcerpt_s = 30.0;

std::string cell(const std::string& text) { return fmt::format("<td>{}</td>", html_escaped(text)); }

std::string drives(const Verdict& verdict) {
  std::string html =
      "<table>\n<tr><th>drive</th><th>R2: curve</th><th>ridge</th><th>dead time</th><th>lag</th>"
      "<th>to 50, 90 %</th><th>edge +, -, of 1000</th><th>fastest</th><th>at the tip</th></tr>\n";
  for (std::size_t at = 0; at < verdict.drive.size(); ++at) {
    const DriveVerdict& of = verdict.drive[at];
    const DriveTrack& track = verdict.tracks.drive[at];
    html += "<tr>" + cell(track.name());
    if (!of.useful) {
      html += of.fitted
                  ? cell(fmt::format("{:.3f}", of.curve.judged_r2)) +
                        cell(fmt::format("{:.3f}", of.ridge.judged_r2)) +
                        "<td colspan=\"6\">does not follow its command</td></tr>\n"
                  : std::string("<td colspan=\"8\">no command and motion together</td></tr>\n");
      continue;
    }
    const auto edge = [&](double side) {
      return of.curve.edge(side) == 0.0 ? std::string("-")
                                        : fmt::format("{:.0f}", 1e3 * of.curve.edge(side));
    };
    html +=
        cell(fmt::format("{:.3f}", of.curve.judged_r2)) +
        cell(fmt::format("{:.3f}", of.ridge.judged_r2)) + cell(dead_time_text(of.curve)) +
        cell(fmt::format("{:.0f} ms", 1e3 * of.curve.lag_s)) +
        cell(fmt::format("{:.0f}, {:.0f} ms", 1e3 * of.curve.half_s(), 1e3 * of.curve.most_s())) +
        cell(edge(1.0) + ", " + edge(-1.0)) +
        cell(fmt::format("{:.3g} {}/s", track.figures.fastest, track.unit())) +
        cell(of.tip_m > 0.0 ? fmt::format("{:.0f} mm", 1e3 * of.tip_m) : "-") + "</tr>\n";
  }
  return html + "</table>\n";
}

std::string curve_plot(const DriveTrack& track, const CurveFit& fit) {
  PlotPoints points;
  PlotPoints driven;
  double most = 1e-3;
  for (std::size_t at = 0; at < fit.knot.size(); ++at) {
    points.emplace_back(fit.knot[at], fit.speed[at]);
    if (fit.driven[at] != 0) {
      driven.emplace_back(fit.knot[at], fit.speed[at]);
    }
    most = std::max(most, std::abs(fit.speed[at]));
  }
  Plot plot(fmt::format("{}: speed by command", track.name()), {"command, of full", -1.0, 1.0},
            {fmt::format("{}/s", track.unit()), -1.1 * most, 1.1 * most}, kPlotWidth_px,
            kPlotHeight_px);
  plot.line("new", points);
  plot.dots("dot", driven);
  return fmt::format("<div><h3>{}</h3>\n{}</div>\n", track.name(), plot.svg());
}

/// Where the drive goes farthest of all pieces.
std::string motion_plot(const Verdict& verdict, std::size_t at) {
  const Tracks& tracks = verdict.tracks;
  const DriveTrack& track = tracks.drive[at];
  const auto rows = static_cast<std::size_t>(kExcerpt_s / tracks.step_s);
  std::size_t best = 0;
  std::size_t from = 0;
  double farthest = -1.0;
  for (std::size_t n = 0; n < tracks.pieces.size(); ++n) {
    const std::vector<double>& velocity = tracks.pieces[n].velocity[at];
    for (std::size_t begin = 0; begin < velocity.size(); begin += rows) {
      double way = 0.0;
      for (std::size_t row = begin; row < std::min(begin + rows, velocity.size()); ++row) {
        way += std::abs(velocity[row]);
      }
      if (way > farthest) {
        farthest = way;
        best = n;
        from = begin;
      }
    }
  }
  const Tracks::Piece& piece = tracks.pieces[best];
  const std::vector<identify::SimpleRun> runs = simple_runs(tracks, at);
  const std::vector<double> predicted =
      curve_velocities({runs[best]}, at, verdict.drive[at].curve).front();
  const std::size_t until = std::min(from + rows, piece.time_s.size());
  PlotPoints measured;
  PlotPoints model;
  double most = 1e-3;
  for (std::size_t row = from; row < until; ++row) {
    measured.emplace_back(piece.time_s[row], piece.velocity[at][row]);
    model.emplace_back(piece.time_s[row], predicted[row]);
    most = std::max({most, std::abs(piece.velocity[at][row]), std::abs(predicted[row])});
  }
  Plot plot(fmt::format("{}: measured and predicted speed", track.name()),
            {"s, gaps as 10 s", piece.time_s[from], piece.time_s[until - 1]},
            {fmt::format("{}/s", track.unit()), -1.1 * most, 1.1 * most}, kWide_px, kPlotHeight_px);
  plot.line("measured", measured);
  plot.line("new", model);
  return fmt::format("<h3>{}</h3>\n{}", track.name(), plot.svg());
}

std::string draft(const Verdict& verdict) {
  std::string html =
      "<table>\n<tr><th>key</th><th>value</th><th>band, or why it is missing</th></tr>\n";
  for (const identify::DraftValue& value : verdict.draft) {
    html += "<tr>" + cell(value.key) + cell(value.value.empty() ? "missing" : value.value) +
            cell(value.text) + "</tr>\n";
  }
  return html + "</table>\n";
}

}  // namespace

std::string verdict_page(const Verdict& verdict) {
  std::vector<std::string> sources;
  std::vector<std::string> known;
  std::vector<std::string> next;
  std::string curves;
  std::string motion;
  for (std::size_t at = 0; at < verdict.drive.size(); ++at) {
    const DriveVerdict& of = verdict.drive[at];
    const DriveTrack& track = verdict.tracks.drive[at];
    sources.insert(sources.end(), track.sources.begin(), track.sources.end());
    known.insert(known.end(), of.known.begin(), of.known.end());
    next.insert(next.end(), of.next.begin(), of.next.end());
    if (of.useful) {
      curves += curve_plot(track, of.curve);
      motion += motion_plot(verdict, at);
    }
  }
  const auto or_nothing = [](const std::vector<std::string>& items) {
    return items.empty() ? std::string("<p>Nothing.</p>\n") : listed(items);
  };
  std::string html = page_head(verdict.log.name + ": verdict", verdict.log.name, "verdict");
  html += section("What is in it", "", or_nothing(content_sentences(verdict)));
  html += section("How the drives answer",
                  "Of motion that was left out: R2 is the share of the speed's variance that is "
                  "explained, from commands and measured pose.",
                  drives(verdict) + "<p>" + html_escaped(tip_sentence(verdict)) + ".</p>\n");
  html += section("What can be known from it", "", or_nothing(known));
  html += section("What to drive next", "", or_nothing(next));
  if (!curves.empty()) {
    html += section("Speed by command",
                    "<span class=\"key d\">Dots</span>: driven often enough to count.",
                    "<div class=\"plots\">\n" + curves + "</div>\n");
    html += section("Speed, where each drive moved most",
                    "<span class=\"key\">measured</span>, <span class=\"key n\">curve with dead "
                    "time and lag</span>.",
                    motion);
  }
  html += section("Draft of a profile", "", draft(verdict) + listed(verdict.lacks));
  html += section("What the columns were taken for", "", or_nothing(sources));
  return html + kPageEnd;
}

}  // namespace graben::reports
