// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The section of a dozer whose blade tilts.

#include "app/machines/toml_reader.hpp"
#include "firmware/dozer/dozer_profile.hpp"

namespace graben::machines {

/// [tilt], or none.
[[nodiscard]] TiltProfile read_tilt(TomlReader& reader);

/// That the cylinder's lever holds over the whole range. Made only where each key by itself is
/// right.
void check_tilt(TomlReader& reader, const TiltProfile& tilt);

}  // namespace graben::machines
