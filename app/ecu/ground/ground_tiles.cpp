// SPDX-License-Identifier: Apache-2.0
#include "app/ecu/ground/ground_tiles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace graben::ground {
namespace {

constexpr double kMostShort = std::numeric_limits<std::int16_t>::max();

/// Along an axis: the number of the tile that a cell is in.
std::int32_t tile_number(std::int32_t cell) {
  return cell >= 0 ? cell / kTileSide : -((kTileSide - 1 - cell) / kTileSide);
}

bool packed(double height_m, std::int32_t base, std::int16_t& to) {
  const double counts = std::round(height_m / kHeight_m) - base;
  if (!(std::abs(counts) <= kMostShort)) {
    return false;
  }
  to = static_cast<std::int16_t>(counts);
  return true;
}

std::uint32_t whole_s(double time_s) {
  return static_cast<std::uint32_t>(std::clamp(time_s, 0.0, 4.294967295e9));
}

}  // namespace

Cell Tile::at(std::size_t n) const {
  const TileCell& from = cell[n];
  Cell to;
  to.lowest_m = kHeight_m * (base + from.lowest);
  to.newest_m = kHeight_m * (base + from.newest);
  to.lowest_s = from.lowest_s;
  to.newest_s = from.newest_s + 0.01 * from.newest_cs;
  to.passes = from.passes;
  return to;
}

bool Tile::put(std::size_t n, const Cell& from) {
  TileCell to;
  if (!packed(from.lowest_m, base, to.lowest) || !packed(from.newest_m, base, to.newest)) {
    return false;
  }
  to.lowest_s = whole_s(from.lowest_s);
  to.newest_s = whole_s(from.newest_s);
  to.newest_cs =
      static_cast<std::uint8_t>(std::clamp(100.0 * (from.newest_s - to.newest_s), 0.0, 99.0));
  to.passes = static_cast<std::uint8_t>(
      std::min<std::uint32_t>(from.passes, std::numeric_limits<std::uint8_t>::max()));
  cell[n] = to;
  return true;
}

Tile* GroundTiles::tile_of(const CellPlace& place, double height_m, bool is_to_be_made,
                           std::size_t& cell) {
  const std::int32_t i = tile_number(place.i);
  const std::int32_t j = tile_number(place.j);
  cell = static_cast<std::size_t>(kTileSide * (place.j - kTileSide * j) + place.i - kTileSide * i);
  const auto is_it = [&](const Tile& tile) { return tile.is_used && tile.i == i && tile.j == j; };
  if (is_it(tile_[last_])) {
    return &tile_[last_];
  }
  for (std::size_t n = 0; n < used_; ++n) {
    if (is_it(tile_[n])) {
      last_ = n;
      return &tile_[n];
    }
  }
  const double base = std::round(height_m / kHeight_m);
  if (!is_to_be_made) {
    return nullptr;
  }
  if (used_ >= kMostTiles || std::abs(i) > kMostShort || std::abs(j) > kMostShort ||
      !(std::abs(base) < 1e9)) {
    ++lost_;
    return nullptr;
  }
  last_ = used_++;
  Tile& tile = tile_[last_];
  tile.is_used = true;
  tile.i = static_cast<std::int16_t>(i);
  tile.j = static_cast<std::int16_t>(j);
  tile.base = static_cast<std::int32_t>(base);
  return &tile;
}

void GroundTiles::put(Tile& tile, std::size_t n, const Cell& cell) {
  if (tile.put(n, cell)) {
    changed_[static_cast<std::size_t>(&tile - tile_.data())] = true;
  } else {
    ++lost_;
  }
}

void GroundTiles::add(const EdgeStep& step) {
  over_cells(step, kCell_m, [&](const CellPlace& place, double height_m) {
    std::size_t n = 0;
    Tile* const tile = tile_of(place, height_m, step.to.at_work, n);
    if (tile == nullptr) {
      return;
    }
    Cell cell = tile->at(n);
    if (makes_ground(cell, height_m, step.to.at_work)) {
      pass_over(cell, height_m, step.time_s);
      put(*tile, n, cell);
    }
  });
}

void GroundTiles::join(const CellPlace& place, const Cell& cell) {
  std::size_t n = 0;
  if (Tile* const tile = tile_of(place, cell.lowest_m, true, n)) {
    put(*tile, n, joined(tile->at(n), cell));
  }
}

void GroundTiles::change_all() { std::fill_n(changed_.begin(), used_, true); }

}  // namespace graben::ground
