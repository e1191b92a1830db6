// SPDX-License-Identifier: Apache-2.0
#include "app/built/ground_folder.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <system_error>

#include "app/ecu/ground/ground_record.hpp"
#include "app/ecu/store/folder_files.hpp"

namespace graben::built {

GroundFolder read_ground_folder(const std::string& folder, std::uint32_t hash, bool any_machine) {
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error)) {
    throw std::runtime_error(fmt::format(
        "--record: {}: {}", folder,
        error ? error.message() : "is no folder; wanted: that of graben-ecu's --store"));
  }
  ecu::FolderFiles files(folder, ecu::FolderFiles::Missing::kIsAnError);
  if (!files.open()) {
    throw std::runtime_error(fmt::format("--record: {}", files.error()));
  }
  const ground::StoredGround stored = ground::read_stored_ground(files);
  GroundFolder result;
  const auto note = [&](const char* what, const std::vector<std::string>& names) {
    if (!names.empty()) {
      result.notes.push_back(fmt::format("{}: {}: {}", folder, what, fmt::join(names, ", ")));
    }
  };
  note("damaged", stored.damaged);
  note("not read", stored.unreadable);
  note("of a format that this version does not know", stored.other_format);
  if (stored.others > 0) {
    result.notes.push_back(fmt::format(
        "{}: {} tiles are of other profiles than the newest and left out", folder, stored.others));
  }
  if (stored.tiles.empty()) {
    throw std::runtime_error(fmt::format(
        "--record: {}: no ground in it{}; a controller keeps it whose profile says how wide the "
        "edge is (bucket.width, tilt.edge_width)",
        folder, result.notes.empty() ? "" : " that can be read (" + result.notes.front() + ")"));
  }
  if (stored.profile_hash != hash && !any_machine) {
    throw std::runtime_error(fmt::format(
        "--record: {}: its ground is of profile {:08x}, not {:08x}; with --any-machine it is "
        "taken all the same",
        folder, stored.profile_hash, hash));
  }
  result.from_s = std::numeric_limits<double>::infinity();
  for (const ground::Tile& tile : stored.tiles) {
    for (std::size_t n = 0; n < ground::kTileCells; ++n) {
      const Cell cell = tile.at(n);
      if (cell.passes > 0) {
        result.grid.put(tile.place_of(n), cell);
        result.from_s = std::min(result.from_s, std::min(cell.lowest_s, cell.newest_s));
        result.until_s = std::max(result.until_s, cell.newest_s);
      }
    }
  }
  if (result.grid.size() == 0) {
    throw std::runtime_error(fmt::format("--record: {}: its tiles have no cell", folder));
  }
  return result;
}

}  // namespace graben::built
