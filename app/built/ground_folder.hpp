// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The as-built record of a controller, from the folder of its store.

#include <cstdint>
#include <string>
#include <vector>

#include "app/built/cell_grid.hpp"
#include "app/ecu/ground/ground_tiles.hpp"

namespace graben::built {

struct GroundFolder {
  CellGrid grid{ground::kCell_m};
  double from_s = 0.0;  ///< Of the oldest and the newest height; see EdgeStep.
  double until_s = 0.0;
  std::vector<std::string> notes;  ///< Files that are damaged or left out.
};

/// Throws std::runtime_error where there is no such folder, no ground in it, or where it is that of
/// another profile than `hash`, unless `any_machine`. Nothing is written.
[[nodiscard]] GroundFolder read_ground_folder(const std::string& folder, std::uint32_t hash,
                                              bool any_machine);

}  // namespace graben::built
