// SPDX-License-Identifier: Apache-2.0
#include "app/runs/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace graben::runs {

double plain_number(double value, int digits) {
  return std::isfinite(value)
             ? std::strtod(fmt::format("{:.{}g}", value, digits).c_str(), nullptr) + 0.0
             : value;
}

std::string shown_value(const FigureValue& figure) {
  const ShownUnit& unit = figure.info->unit;
  return fmt::format("{:.{}f}", unit.per_si * figure.value, unit.decimals);
}

void lead_with(const std::vector<std::string>& names, RunFigures& figures) {
  const auto place = [&](const FigureValue& figure) {
    return std::find(names.begin(), names.end(), figure.info->name) - names.begin();
  };
  std::stable_sort(figures.values.begin(), figures.values.end(),
                   [&](const FigureValue& a, const FigureValue& b) { return place(a) < place(b); });
}

std::string figures_text(const RunFigures& figures) {
  std::string text;
  for (const FigureValue& figure : figures.values) {
    if (std::isfinite(figure.value)) {
      const char* unit = figure.info->unit.text;
      text += fmt::format("{:<{}}{:>10}{}{}\n", figure.info->text, kFigureTextWidth,
                          shown_value(figure), *unit != '\0' ? " " : "", unit);
    }
  }
  text += fmt::format("{}\n", figures.limits_text);
  for (const auto& [name, share] : figures.limit_share) {
    text += fmt::format("  {:<{}}{:>10.1f} %\n", name, kFigureTextWidth - 2, share * 100.0);
  }
  return text;
}

}  // namespace graben::runs
