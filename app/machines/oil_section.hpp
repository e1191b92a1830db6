// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The section [oil] of an excavator's file: what its controller takes the oil and its load to be.

#include "app/machines/toml_reader.hpp"
#include "firmware/excavator/excavator_profile.hpp"

namespace graben::machines {

/// Nothing known where the file has no such section.
[[nodiscard]] OilProfile read_oil(TomlReader& reader);

/// An error where the law needs what is not known.
void check_law(TomlReader& reader, const ExcavatorProfile& profile);

}  // namespace graben::machines
