// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Ground that a cutting edge has made, on a grid of cells seen from above: at each cell's centre
/// the newest and the lowest height at which the edge was there, when and how often.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "app/ecu/ground/cells.hpp"

namespace graben::built {

using ground::Cell;
using ground::CellPlace;

/// The same as one number, for look-ups.
[[nodiscard]] inline std::uint64_t cell_key(const CellPlace& place) {
  return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(place.j)) << 32U) |
         static_cast<std::uint32_t>(place.i);
}

inline constexpr double kLeastGrid_m = 0.02;
inline constexpr double kMostGrid_m = 2.0;
inline constexpr std::size_t kMostCells = 1'000'000;
/// A newest pass this much over the lowest one went through soil that has come there, m.
inline constexpr double kFallen_m = 0.01;

class CellGrid {
 public:
  explicit CellGrid(double grid_m) : grid_m_(grid_m) {}

  /// The edge went over the ground between its two places. That is ground where the edge was at
  /// work; and, at work or not, where it went below ground that is known there: it can only have
  /// cut that. Throws std::runtime_error beyond kMostCells.
  void add(const ground::EdgeStep& step);
  /// A cell as a record has it; of one that is known already the lowest and the newest.
  void put(const CellPlace& place, const Cell& cell);

  [[nodiscard]] double grid_m() const { return grid_m_; }
  [[nodiscard]] std::size_t size() const { return cell_.size(); }
  /// In the order of y, then x.
  [[nodiscard]] std::vector<std::pair<CellPlace, Cell>> sorted() const;
  [[nodiscard]] const Cell* at(const CellPlace& place) const;
  [[nodiscard]] Eigen::Vector2d centre_m(const CellPlace& place) const {
    return grid_m_ * Eigen::Vector2d(place.i + 0.5, place.j + 0.5);
  }

 private:
  void demand_room() const;

  double grid_m_;
  std::unordered_map<std::uint64_t, Cell> cell_;
};

}  // namespace graben::built
