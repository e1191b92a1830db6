// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Messages of a bus profile, one by one, into a table.

#include <string>
#include <vector>

#include "app/machines/dbc_layout.hpp"
#include "app/machines/toml_reader.hpp"
#include "hal/buses/bus_table.hpp"

namespace graben::machines {

/// What the messages of a profile go by.
struct BusContext {
  std::vector<DbcMessage> dbc;  ///< Empty: layouts stand in the profile itself.
  std::string dbc_name;
  bool is_unread = false;  ///< The DBC that it names: whatever else is wrong follows from that.
  std::vector<std::string> interfaces;  ///< In the order of the process's buses; empty: one.
};

/// [[node]], then [[receive]], which names nodes, and [[send]], their signals with them. Errors go
/// to the reader.
void read_nodes(TomlReader& reader, const BusContext& context, BusTable& table);
void read_received(TomlReader& reader, const BusContext& context, BusTable& table);
void read_sent(TomlReader& reader, const BusContext& context, BusTable& table);

}  // namespace graben::machines
