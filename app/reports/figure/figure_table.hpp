// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Figures of one paper by their names: arrays of pairs, a name and what draws it.

#include <algorithm>
#include <string>
#include <vector>

namespace graben::reports {

template <class Figures>
[[nodiscard]] std::vector<std::string> names_of(const Figures& figures) {
  std::vector<std::string> names;
  for (const auto& [name, draw] : figures) {
    names.emplace_back(name);
  }
  return names;
}

/// What draws the figure; `name` has to be one of names_of().
template <class Figures>
[[nodiscard]] auto draw_of(const Figures& figures, const std::string& name) {
  return std::find_if(figures.begin(), figures.end(),
                      [&](const auto& figure) { return name == figure.first; })
      ->second;
}

}  // namespace graben::reports
