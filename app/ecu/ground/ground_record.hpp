// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Tiles of ground as they lie in a store: a record each, by its number among the tiles. All
/// numbers little endian; 3598 bytes of payload.
///
/// | byte | what |
/// |---|---|
/// | 0  | side of a cell, mm, 16 bits |
/// | 2  | unit of a height, 0.1 mm, 16 bits |
/// | 4  | number of the tile along x and y, 16 bits each, signed |
/// | 8  | base of its heights, 32 bits, signed; 2 bytes of 0 |
/// | 14 | 256 cells, along x first: lowest and newest over the base, 16 bits each, signed; when, in
/// seconds since 1970, 32 bits each; hundredths of the newest; passes, 0 where there is no ground |

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "app/ecu/ground/ground_tiles.hpp"
#include "app/ecu/store/record_format.hpp"
#include "app/ecu/store/store_files.hpp"

namespace graben::ground {

inline constexpr std::size_t kTileBytes = 14 + 14 * kTileCells;
static_assert(kTileBytes <= ecu::kMostPayloadBytes, "a tile is one record");

[[nodiscard]] constexpr ecu::RecordKey tile_key(std::size_t n) {
  return {ecu::RecordKind::kGround, static_cast<std::uint16_t>(n)};
}

/// Returns the bytes, kTileBytes.
std::size_t write_tile(const Tile& tile, std::uint8_t* to);
/// False where the bytes are no tile of this format, in its cells and units.
[[nodiscard]] bool read_tile(const std::uint8_t* from, std::size_t count, Tile& tile);

/// A record as a tool reads it, of whatever profile; nothing is written.
struct StoredGround {
  std::vector<Tile> tiles;                ///< Of that profile.
  std::uint32_t profile_hash = 0;         ///< That has the newest cell.
  std::size_t others = 0;                 ///< Tiles of other profiles.
  std::vector<std::string> damaged;       ///< Files, where the other copy counts too.
  std::vector<std::string> unreadable;    ///< Files that are there, and why they are not read.
  std::vector<std::string> other_format;  ///< Files of a format that this program does not know.
};

/// Never throws for what is in the files.
[[nodiscard]] StoredGround read_stored_ground(ecu::StoreFiles& files);

}  // namespace graben::ground
