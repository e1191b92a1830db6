// SPDX-License-Identifier: Apache-2.0
#include "app/ecu/ground/ground_record.hpp"

#include <algorithm>
#include <cmath>

#include "app/ecu/store/byte_order.hpp"
#include "app/ecu/store/store.hpp"

namespace graben::ground {
namespace {

constexpr auto kCell_mm = static_cast<std::uint16_t>(1e3 * kCell_m + 0.5);
constexpr auto kHeightUnit = static_cast<std::uint16_t>(1e4 * kHeight_m + 0.5);

std::uint32_t newest_s(const Tile& tile) {
  std::uint32_t newest = 0;
  for (const TileCell& cell : tile.cell) {
    newest = std::max(newest, cell.newest_s);
  }
  return newest;
}

}  // namespace

std::size_t write_tile(const Tile& tile, std::uint8_t* to) {
  ecu::ByteWriter writer(to, kTileBytes);
  writer.u16(kCell_mm);
  writer.u16(kHeightUnit);
  writer.u16(static_cast<std::uint16_t>(tile.i));
  writer.u16(static_cast<std::uint16_t>(tile.j));
  writer.u32(static_cast<std::uint32_t>(tile.base));
  writer.u16(0);
  for (const TileCell& cell : tile.cell) {
    writer.u16(static_cast<std::uint16_t>(cell.lowest));
    writer.u16(static_cast<std::uint16_t>(cell.newest));
    writer.u32(cell.lowest_s);
    writer.u32(cell.newest_s);
    writer.u8(cell.newest_cs);
    writer.u8(cell.passes);
  }
  return writer.count();
}

bool read_tile(const std::uint8_t* from, std::size_t count, Tile& tile) {
  if (count != kTileBytes) {
    return false;
  }
  ecu::ByteReader reader(from, count);
  if (reader.u16() != kCell_mm || reader.u16() != kHeightUnit) {
    return false;
  }
  tile.is_used = true;
  tile.i = static_cast<std::int16_t>(reader.u16());
  tile.j = static_cast<std::int16_t>(reader.u16());
  tile.base = static_cast<std::int32_t>(reader.u32());
  static_cast<void>(reader.u16());
  for (TileCell& cell : tile.cell) {
    cell.lowest = static_cast<std::int16_t>(reader.u16());
    cell.newest = static_cast<std::int16_t>(reader.u16());
    cell.lowest_s = reader.u32();
    cell.newest_s = reader.u32();
    cell.newest_cs = std::min<std::uint8_t>(reader.u8(), 99);
    cell.passes = reader.u8();
  }
  return reader.good();
}

StoredGround read_stored_ground(ecu::StoreFiles& files) {
  StoredGround result;
  struct Found {
    Tile tile;
    std::uint32_t hash = 0;
  };
  std::vector<Found> all;
  ecu::RecordBytes record{};
  for (std::size_t n = 0; n < kMostTiles; ++n) {
    const ecu::RecordKey key = tile_key(n);
    const ecu::FoundRecord found = ecu::find_record(files, key, record);
    for (unsigned copy = 0; copy < 2; ++copy) {
      const std::string name = ecu::file_name(key, copy).data();
      if (found.copy[copy] == ecu::CopyState::kDamaged) {
        result.damaged.push_back(name);
      } else if (found.copy[copy] == ecu::CopyState::kOtherVersion) {
        result.other_format.push_back(name);
      } else if (found.copy[copy] == ecu::CopyState::kUnreadable) {
        std::uint8_t byte = 0;
        result.unreadable.emplace_back(files.read(name.c_str(), &byte, 1) < 0 ? files.error()
                                                                              : name.c_str());
      }
    }
    if (found.newest < 0) {
      continue;
    }
    Found one;
    one.hash = found.head.profile_hash;
    if (read_tile(record.data() + ecu::kHeadBytes, found.head.length, one.tile)) {
      all.push_back(one);
    } else {
      result.other_format.emplace_back(
          ecu::file_name(key, static_cast<unsigned>(found.newest)).data());
    }
  }
  const auto newest = std::max_element(all.begin(), all.end(), [](const Found& a, const Found& b) {
    return newest_s(a.tile) < newest_s(b.tile);
  });
  for (const Found& one : all) {
    result.profile_hash = newest->hash;
    if (one.hash == newest->hash) {
      result.tiles.push_back(one.tile);
    } else {
      ++result.others;
    }
  }
  return result;
}

}  // namespace graben::ground
