// SPDX-License-Identifier: Apache-2.0
#include "app/reports/built/built_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "app/reports/identify/page_style.hpp"
#include "app/reports/identify/plot.hpp"

namespace graben::reports {
namespace {

using built::BuiltGround;
using built::BuiltPoint;

/// From here on up to the next one. The colours of the scope's map (view/panels/built_map.ts),
/// which also those tell apart who see no red and green: blue is too low, red too high.
struct Band {
  double least_m;
  std::string colour;
  std::string words;
};

const std::vector<Band>& off_bands() {
  static const std::vector<Band> bands = {
      {-1e9, "#2166ac", "fill: more than 60 mm under the design"},
      {-0.06, "#67a9cf", "fill: 30 to 60 mm under it"},
      {-0.03, "#b5d6e8", "fill: 10 to 30 mm under it"},
      {-0.01, "#f7f7f7", "within 10 mm of the design"},
      {0.01, "#fbc9ae", "cut: 10 to 30 mm over it"},
      {0.03, "#ef8a62", "cut: 30 to 60 mm over it"},
      {0.06, "#b2182b", "cut: more than 60 mm over it"}};
  return bands;
}

/// Of heights, even ones between the lowest and the highest.
std::vector<Band> height_bands(const std::vector<BuiltPoint>& points) {
  constexpr std::array<const char*, 7> kColours = {"#084594", "#2171b5", "#4292c6", "#6baed6",
                                                   "#9ecae1", "#c6dbef", "#eff3ff"};
  const auto [low, high] = std::minmax_element(
      points.begin(), points.end(),
      [](const BuiltPoint& a, const BuiltPoint& b) { return a.at_m.z() < b.at_m.z(); });
  const double least_m = low->at_m.z();
  const double step_m = std::max(1e-3, (high->at_m.z() - least_m) / kColours.size());
  std::vector<Band> bands;
  for (std::size_t n = 0; n < kColours.size(); ++n) {
    const double from_m = least_m + static_cast<double>(n) * step_m;
    bands.push_back({n == 0 ? -1e9 : from_m, kColours[n],
                     fmt::format("{:.2f} to {:.2f} m", from_m, from_m + step_m)});
  }
  return bands;
}

std::size_t band_of(const std::vector<Band>& bands, double value_m) {
  std::size_t found = 0;
  while (found + 1 < bands.size() && value_m >= bands[found + 1].least_m) {
    ++found;
  }
  return found;
}

/// Cells as the map shows them: several as one where there are more than it has room for.
struct Map {
  /// Mean of the block's cells, by its row (x) and column (y).
  std::map<std::pair<int, int>, std::pair<double, int>> block;
  int stride = 1;
};

constexpr int kMostBlocks = 300;  ///< Along each side.

Map map_of(const BuiltGround& ground, bool has_design) {
  Map map;
  built::CellPlace first = ground.point.front().cell;
  built::CellPlace last = first;
  for (const BuiltPoint& point : ground.point) {
    first = {std::min(first.i, point.cell.i), std::min(first.j, point.cell.j)};
    last = {std::max(last.i, point.cell.i), std::max(last.j, point.cell.j)};
  }
  map.stride = 1 + std::max(last.i - first.i, last.j - first.j) / kMostBlocks;
  for (const BuiltPoint& point : ground.point) {
    const double value_m = has_design ? point.off_m : point.at_m.z();
    if (std::isfinite(value_m)) {
      // x is up, y to the left.
      auto& [sum_m, count] =
          map.block[{(last.i - point.cell.i) / map.stride, (last.j - point.cell.j) / map.stride}];
      sum_m += value_m;
      ++count;
    }
  }
  return map;
}

std::string map_svg(const Map& map, const std::vector<Band>& bands, double block_m,
                    std::vector<bool>& used) {
  constexpr double kMostWidth_px = 1100.0;
  constexpr double kMostBlock_px = 24.0;
  int rows = 0;
  int columns = 0;
  for (const auto& [at, mean] : map.block) {
    rows = std::max(rows, at.first + 1);
    columns = std::max(columns, at.second + 1);
  }
  const double px = std::min({kMostBlock_px, kMostWidth_px / columns, 700.0 / rows});
  const double metre_px = px / block_m;
  const double width_px = std::max(px * columns, metre_px) + 2.0;
  std::string svg = fmt::format(
      "<svg role=\"img\" aria-label=\"The ground seen from above, in colours\" viewBox=\"0 0 "
      "{0:.1f} {1:.1f}\" style=\"width: {0:.0f}px; max-width: 100%; background: var(--line)\" "
      "shape-rendering=\"crispEdges\">\n",
      width_px, px * rows + 24.0);
  // Neighbours of one colour are one rectangle.
  for (auto at = map.block.begin(); at != map.block.end();) {
    const auto [row, column] = at->first;
    const std::size_t band = band_of(bands, at->second.first / at->second.second);
    used[band] = true;
    int length = 0;
    for (; at != map.block.end() && at->first == std::pair(row, column + length) &&
           band_of(bands, at->second.first / at->second.second) == band;
         ++at) {
      ++length;
    }
    svg += fmt::format(
        "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"/>\n",
        px * column, px * row, px * length, px, bands[band].colour);
  }
  return svg + fmt::format(
                   "<path class=\"measured\" d=\"M1 {0:.1f}v4h{1:.1f}v-4\"/><text class=\"tick\" "
                   "x=\"1\" y=\"{2:.1f}\">1 m</text></svg>\n",
                   px * rows + 5.0, metre_px, px * rows + 21.0);
}

std::string legend(const std::vector<Band>& bands, const std::vector<bool>& used) {
  std::string html = "<table style=\"width: auto\">\n";
  for (std::size_t n = bands.size(); n-- > 0;) {
    if (used[n]) {
      html += fmt::format(
          "<tr><td><svg style=\"width: 22px\" viewBox=\"0 0 22 14\"><rect width=\"22\" "
          "height=\"14\" fill=\"{}\" stroke=\"#888\"/></svg></td><td>{}</td></tr>\n",
          bands[n].colour, bands[n].words);
    }
  }
  return html + "</table>\n";
}

}  // namespace

std::string built_page(const BuiltGround& ground, const built::BuiltHead& head,
                       const std::optional<built::DesignFigures>& design,
                       const std::vector<std::string>& notes) {
  const std::vector<Band> bands = design ? off_bands() : height_bands(ground.point);
  const Map map = map_of(ground, design.has_value());
  std::vector<bool> used(bands.size());
  const std::string svg = map_svg(map, bands, ground.grid_m * map.stride, used);
  std::string page = page_head("As built", head.project,
                               fmt::format("{}, {}", head.machine, built::utc_text(head.until_s)));
  page += section(design ? "Cut and fill" : "Heights",
                  "From above, in the frame of the machine: x is up, y to the left. Where it "
                  "is grey the edge has not been at work.",
                  svg + legend(bands, used));
  page +=
      section("Figures", "", "<pre>" + html_escaped(table_text(ground, head, design)) + "</pre>");
  if (!notes.empty()) {
    page += section("Notes", "", listed(notes));
  }
  return page + kPageEnd;
}

}  // namespace graben::reports
