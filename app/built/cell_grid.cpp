// SPDX-License-Identifier: Apache-2.0
#include "app/built/cell_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace graben::built {
void CellGrid::demand_room() const {
  if (cell_.size() >= kMostCells) {
    throw std::runtime_error(fmt::format("more than {} cells of {} m; a larger --grid makes fewer",
                                         kMostCells, grid_m_));
  }
}

void CellGrid::add(const ground::EdgeStep& step) {
  ground::over_cells(step, grid_m_, [&](const CellPlace& place, double height_m) {
    const auto found = cell_.find(cell_key(place));
    Cell cell = found == cell_.end() ? Cell{} : found->second;
    if (!ground::makes_ground(cell, height_m, step.to.at_work)) {
      return;
    }
    ground::pass_over(cell, height_m, step.time_s);
    if (found == cell_.end()) {
      demand_room();
      cell_.emplace(cell_key(place), cell);
    } else {
      found->second = cell;
    }
  });
}

void CellGrid::put(const CellPlace& place, const Cell& cell) {
  const auto found = cell_.find(cell_key(place));
  if (found == cell_.end()) {
    demand_room();
    cell_.emplace(cell_key(place), cell);
  } else {
    found->second = ground::joined(found->second, cell);
  }
}

std::vector<std::pair<CellPlace, Cell>> CellGrid::sorted() const {
  std::vector<std::pair<CellPlace, Cell>> all;
  all.reserve(cell_.size());
  for (const auto& [at, cell] : cell_) {
    const CellPlace place{static_cast<std::int32_t>(static_cast<std::uint32_t>(at)),
                          static_cast<std::int32_t>(static_cast<std::uint32_t>(at >> 32U))};
    all.emplace_back(place, cell);
  }
  std::sort(all.begin(), all.end(), [](const auto& one, const auto& other) {
    return std::pair(one.first.j, one.first.i) < std::pair(other.first.j, other.first.i);
  });
  return all;
}

const Cell* CellGrid::at(const CellPlace& place) const {
  const auto found = cell_.find(cell_key(place));
  return found == cell_.end() ? nullptr : &found->second;
}

}  // namespace graben::built
