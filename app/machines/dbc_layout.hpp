// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Layouts of messages and signals, of a DBC file: what its BO_ and SG_ lines say, nothing more.
/// Files of others have a part that a profile does not name, and that may be as it likes: what is
/// wrong stands with the message or the signal, for whoever names it.

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
  std::string wrong = {};  ///< Why its line can't be used, with file and line; empty: nothing.
  std::string unit = {};   ///< As the file has it.
  bool supported = true;   ///< Neither multiplexed, nor a float, nor of more than 32 bits.
};

struct DbcMessage {
  std::string name;
  std::uint32_t id = 0;
  bool extended = true;
  int length = 0;
  std::string wrong = {};  ///< As a signal's.
  std::vector<DbcSignal> signal;
};

/// Throws std::runtime_error if it can't be read.
[[nodiscard]] std::vector<DbcMessage> read_dbc(const std::filesystem::path& file);

}  // namespace graben::machines
