// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What messages of both directions and their signals have in a bus profile: ids, bits, scales,
/// protection. Errors go to the reader.

#include <cstdint>
#include <string>

#include "app/machines/bus_tables.hpp"
#include "app/machines/dbc_layout.hpp"
#include "app/machines/toml_reader.hpp"
#include "hal/buses/bus_table.hpp"

namespace graben::machines {

inline constexpr double kMicroseconds = 1e6;
inline constexpr int kMostSignalsEach = 16;
inline constexpr Range kAnyNumber{-1e12, 1e12, ""};

constexpr std::uint8_t small(int value) { return static_cast<std::uint8_t>(value); }

/// A message as it is declared, and its DBC's where that has one.
struct Declared {
  std::string key;
  std::string name;
  const DbcMessage* dbc = nullptr;
  std::uint32_t id = 0;
  bool extended = true;
  int length = 8;
  std::uint8_t bus = kAnyBus;
  TimeUs period_us = 0;
};

[[nodiscard]] Declared read_message(TomlReader& reader, const BusContext& context,
                                    const std::string& key);

/// A signal's bits, of the DBC or of the profile, with scale and offset into the DBC's unit. Bits
/// that are not among the message's are refused.
[[nodiscard]] DbcSignal read_signal(TomlReader& reader, const Declared& message,
                                    const std::string& key);
/// Value in its place of `raw`: profile's scale and offset after the DBC's.
void read_scale(TomlReader& reader, const std::string& key, const DbcSignal& layout, double& scale,
                double& offset);

[[nodiscard]] TableProtection read_protection(TomlReader& reader, const Declared& message,
                                              bool counts_wide, BitField& counter,
                                              std::uint16_t& data_id);

/// Which pump, or which cylinder, a signal is of.
[[nodiscard]] std::uint8_t read_pump(TomlReader& reader, const std::string& key);
[[nodiscard]] std::uint8_t read_axis(TomlReader& reader, const std::string& key);

}  // namespace graben::machines
