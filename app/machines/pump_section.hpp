// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What an excavator's file says of its pumps and of the bypass that they feed.

#include "app/machines/toml_reader.hpp"
#include "firmware/excavator/excavator_profile.hpp"

namespace graben::machines {

/// Tables [[pump]], all of one kind; count and pumps of the profile.
void read_pumps(TomlReader& reader, ExcavatorProfile& profile);

/// valve.bypass of one drive; none where its pumps sense the load.
void read_bypass(TomlReader& reader, const std::string& axis, PumpKind kind, SpoolProfile& spool);

}  // namespace graben::machines
