// SPDX-License-Identifier: Apache-2.0
#include "app/built/cell_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace graben::built {
namespace {

/// Twice the area of a triangle that is none, seen from above, m^2.
constexpr double kNoArea_m2 = 1e-12;
/// So much of a triangle's height outside of it a centre is on its side, which the next one shares.
constexpr double kOnSide = 1e-9;

double cross(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double x_m, double y_m) {
  return (to.x() - from.x()) * (y_m - from.y()) - (to.y() - from.y()) * (x_m - from.x());
}

}  // namespace

void over_cells(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                double grid_m, const std::function<void(const CellPlace&, double height_m)>& take) {
  const double area_m2 = cross(a, b, c.x(), c.y());
  if (!(std::abs(area_m2) > kNoArea_m2)) {
    return;
  }
  const auto first = [grid_m](double least_m) {
    return static_cast<std::int32_t>(std::ceil(least_m / grid_m - 0.5));
  };
  const auto last = [grid_m](double most_m) {
    return static_cast<std::int32_t>(std::floor(most_m / grid_m - 0.5));
  };
  const std::int32_t i0 = first(std::min({a.x(), b.x(), c.x()}));
  const std::int32_t i1 = last(std::max({a.x(), b.x(), c.x()}));
  const std::int32_t j0 = first(std::min({a.y(), b.y(), c.y()}));
  const std::int32_t j1 = last(std::max({a.y(), b.y(), c.y()}));
  for (std::int32_t j = j0; j <= j1; ++j) {
    const double y_m = grid_m * (j + 0.5);
    for (std::int32_t i = i0; i <= i1; ++i) {
      const double x_m = grid_m * (i + 0.5);
      const double of_a = cross(b, c, x_m, y_m) / area_m2;
      const double of_b = cross(c, a, x_m, y_m) / area_m2;
      const double of_c = cross(a, b, x_m, y_m) / area_m2;
      if (std::min({of_a, of_b, of_c}) >= -kOnSide) {
        take({i, j}, of_a * a.z() + of_b * b.z() + of_c * c.z());
      }
    }
  }
}

void CellGrid::add(const EdgeStep& step) {
  const auto take = [&](const CellPlace& place, double height_m) {
    pass(place, height_m, step.time_s, step.to.at_work);
  };
  over_cells(step.from.left_m, step.from.right_m, step.to.right_m, grid_m_, take);
  over_cells(step.from.left_m, step.to.right_m, step.to.left_m, grid_m_, take);
}

void CellGrid::pass(const CellPlace& place, double height_m, double time_s, bool at_work) {
  const auto found = cell_.find(cell_key(place));
  if (found == cell_.end()) {
    if (at_work) {
      if (cell_.size() >= kMostCells) {
        throw std::runtime_error(fmt::format(
            "more than {} cells of {} m; a larger --grid makes fewer", kMostCells, grid_m_));
      }
      cell_.emplace(cell_key(place), Cell{height_m, time_s, height_m, time_s, 1});
    }
    return;
  }
  Cell& cell = found->second;
  if (!at_work && height_m >= cell.lowest_m) {
    return;
  }
  const bool is_new = time_s - cell.newest_s > kPass_s;
  cell.newest_m = is_new ? height_m : std::min(cell.newest_m, height_m);
  cell.newest_s = time_s;
  cell.passes += is_new ? 1 : 0;
  if (height_m < cell.lowest_m) {
    cell.lowest_m = height_m;
    cell.lowest_s = time_s;
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
