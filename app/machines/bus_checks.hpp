// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What has to hold across a bus profile's messages, so that what is sent is what was meant.

#include "app/machines/toml_reader.hpp"
#include "hal/buses/bus_table.hpp"

namespace graben::machines {

/// Refuses bits that are sent twice, ids that two messages share or that are our own, values that
/// their bits can't say, a neutral that is not raw 0, and times beyond what a moving machine bears.
/// Errors go to the reader.
void check_bus(TomlReader& reader, const BusTable& table);

}  // namespace graben::machines
