// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What an excavator's file says of its pumps' swash.

#include "app/machines/toml_reader.hpp"
#include "firmware/excavator/excavator_profile.hpp"

namespace graben::machines {

/// task.swash and task.swash_on_demand, of a profile that knows how many pumps it has.
void read_swash(TomlReader& reader, ExcavatorProfile& profile);

}  // namespace graben::machines
