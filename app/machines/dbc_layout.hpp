// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Layouts of messages and signals, of a DBC file: what its BO_ and SG_ lines say, nothing more.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "hal/buses/bus_table.hpp"

namespace graben::machines {

/// A signal in the DBC's own unit: raw * scale + offset.
struct DbcSignal {
  std::string name;
  BitField bits;
  double scale = 1.0;
  double offset = 0.0;
  double least = 0.0;  ///< Both 0: not said.
  double most = 0.0;
  bool supported = true;  ///< Neither multiplexed, nor a float, nor of more than 32 bits.
};

struct DbcMessage {
  std::string name;
  std::uint32_t id = 0;
  bool extended = true;
  int length = 0;
  std::vector<DbcSignal> signal;
};

/// Throws std::runtime_error, with file and line, if it can't be read or a line of these is not as
/// it has to be.
[[nodiscard]] std::vector<DbcMessage> read_dbc(const std::filesystem::path& file);

}  // namespace graben::machines
