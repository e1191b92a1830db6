// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A figure as a paper has it, as SVG: panels one under the other with curves over time, distance
/// or each other, a caption, and beside it the numbers that the paper has, with ours.

#include <string>
#include <vector>

namespace graben::reports {

struct FigureCurve {
  std::string label;  ///< Empty: not in the key.
  std::string colour;
  std::vector<double> x;  ///< A value that is not finite is a gap.
  std::vector<double> y;
  bool dotted = false;
};

/// A word at a place.
struct FigureMark {
  double x = 0.0;
  double y = 0.0;
  std::string text;
};

struct FigurePanel {
  std::string x_title;  ///< With its unit.
  std::string y_title;
  std::vector<FigureCurve> curves;
  std::vector<FigureMark> marks;
  bool is_map = false;  ///< A metre is as long on both axes.
};

/// A number that stands in the paper.
struct PaperNumber {
  std::string what;
  std::string paper;
  std::string ours;
};

struct PaperFigure {
  std::string name;     ///< "kim9"
  std::string caption;  ///< The paper's, in short, and how ours was made.
  std::vector<FigurePanel> panels;
  std::vector<PaperNumber> numbers;
};

[[nodiscard]] std::string svg_text(const PaperFigure& figure);

}  // namespace graben::reports
