// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Bus profiles: another bus than ours, declared in TOML, as a table of the core's
/// (hal/buses/bus_table.hpp) and what that bus can say.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "firmware/signals/bus_capabilities.hpp"
#include "hal/buses/bus_table.hpp"

namespace graben::machines {

/// What the profile calls a message of its table, and its signals, in the table's order.
struct BusWords {
  std::string message;
  std::vector<std::string> signal;
};

struct BusFile {
  std::string speaks;      ///< `bus` of the file: which machine's; a twin goes by it.
  std::uint32_t hash = 0;  ///< Of the checked values.
  BusTable table;
  BusCapabilities capabilities;
  std::vector<BusWords> received;  ///< Beside table.message.
  std::vector<BusWords> sent;      ///< Beside table.send.
};

/// Reads and checks a bus profile. Throws ProfileError with every error found, each with the
/// message and signal that it is of, key and line.
[[nodiscard]] BusFile load_bus(const std::filesystem::path& file);

/// Finds a bus profile as a path, or as NAME or NAME.toml in one of the folders; throws as
/// find_file() does.
[[nodiscard]] std::filesystem::path find_bus(const std::string& name,
                                             const std::vector<std::filesystem::path>& folders);
/// The same among those that the tool brings.
[[nodiscard]] std::filesystem::path find_bus(const std::string& name);
/// What find_bus(name) knows, in order.
[[nodiscard]] std::vector<std::string> shipped_bus_names();

}  // namespace graben::machines
