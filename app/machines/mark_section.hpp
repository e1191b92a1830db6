// SPDX-License-Identifier: Apache-2.0
#pragma once
/// [mark]: where the tool is set to by hand, to see whether it is where it is shown.

#include "app/machines/toml_reader.hpp"
#include "firmware/machine/mark.hpp"

namespace graben::machines {

/// Without the section there is no mark. `swings`: the place is in space, not in the links' plane.
[[nodiscard]] MarkProfile read_mark(TomlReader& reader, bool swings, const char* place_help);

}  // namespace graben::machines
