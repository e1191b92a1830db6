// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A small chart as SVG: lines, a band and points over two axes with a title each.

#include <string>
#include <utility>
#include <vector>

namespace graben::reports {

using PlotPoints = std::vector<std::pair<double, double>>;

struct PlotAxis {
  std::string title;
  double least = 0.0;
  double most = 1.0;
};

class Plot {
 public:
  /// `title` is for those who do not see it.
  Plot(const std::string& title, PlotAxis x, PlotAxis y, double width_px, double height_px);

  /// `style` is the class of the line, the area or the points.
  void line(const char* style, const PlotPoints& points);
  void area(const char* style, const PlotPoints& points);
  void dots(const char* style, const PlotPoints& points);
  [[nodiscard]] std::string svg() const;

 private:
  [[nodiscard]] double x_px(double value) const;
  [[nodiscard]] double y_px(double value) const;
  void axes();
  void path(const char* style, const PlotPoints& points, const char* end);

  PlotAxis x_;
  PlotAxis y_;
  double width_px_;
  double height_px_;
  std::string text_;
};

/// As text of a page.
[[nodiscard]] std::string html_escaped(const std::string& text);

}  // namespace graben::reports
