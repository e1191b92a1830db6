// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The controller's own record of the ground that its edge has made: tiles of 16 by 16 cells, of
/// which there are so many and no more. Memory is taken once.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "app/ecu/ground/cells.hpp"

namespace graben::ground {

/// Side of a cell, m.
inline constexpr double kCell_m = 0.1;
/// Cells along a tile's side.
inline constexpr std::int32_t kTileSide = 16;
inline constexpr std::size_t kTileCells = 256;
/// Tiles: 655 m^2, twice what a 22 t machine reaches from one place.
inline constexpr std::size_t kMostTiles = 256;
/// Unit of a height; +- 16 m of a tile's first one.
inline constexpr double kHeight_m = 5e-4;

/// A cell, packed.
struct TileCell {
  std::int16_t lowest = 0;  ///< kHeight_m over the tile's base.
  std::int16_t newest = 0;
  std::uint32_t lowest_s = 0;  ///< Since 1970, whole seconds.
  std::uint32_t newest_s = 0;
  std::uint8_t newest_cs = 0;  ///< And hundredths.
  std::uint8_t passes = 0;     ///< 255: or more.
};

struct Tile {
  bool is_used = false;
  std::int16_t i = 0;  ///< Its first cell's number along x, over kTileSide.
  std::int16_t j = 0;
  std::int32_t base = 0;  ///< kHeight_m.
  std::array<TileCell, kTileCells> cell{};

  [[nodiscard]] Cell at(std::size_t n) const;
  /// False, and nothing has changed, where a height is too far from the base.
  [[nodiscard]] bool put(std::size_t n, const Cell& from);
  [[nodiscard]] CellPlace place_of(std::size_t n) const {
    return {kTileSide * i + static_cast<std::int32_t>(n % kTileSide),
            kTileSide * j + static_cast<std::int32_t>(n / kTileSide)};
  }
};

class GroundTiles {
 public:
  GroundTiles() : tile_(kMostTiles) {}

  /// The edge went over the ground between two places: see makes_ground().
  void add(const EdgeStep& step);
  /// What a record had of a cell is joined with what is known.
  void join(const CellPlace& place, const Cell& cell);

  [[nodiscard]] const Tile& tile(std::size_t n) const { return tile_[n]; }
  [[nodiscard]] std::size_t used() const { return used_; }
  /// Passes for which there was no room: no tile left, or too high or too deep.
  [[nodiscard]] std::uint32_t lost() const { return lost_; }
  /// Changed since taken_out(); told of each tile in use.
  [[nodiscard]] bool has_changed(std::size_t n) const { return changed_[n]; }
  void written(std::size_t n) { changed_[n] = false; }
  void change_all();

 private:
  /// Null where none is left; one that is made new where `is_to_be_made`.
  Tile* tile_of(const CellPlace& place, double height_m, bool is_to_be_made, std::size_t& cell);
  void put(Tile& tile, std::size_t n, const Cell& cell);

  std::vector<Tile> tile_;
  std::array<bool, kMostTiles> changed_{};
  std::size_t used_ = 0;
  std::size_t last_ = 0;  ///< Where the edge was.
  std::uint32_t lost_ = 0;
};

}  // namespace graben::ground
