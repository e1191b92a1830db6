// SPDX-License-Identifier: Apache-2.0
#pragma once
/// An excavator's outline and what fences allow for, as its profile says them.

#include "firmware/excavator/excavator_profile.hpp"

namespace graben::machines {

class TomlReader;

/// As points where bucket.width is not told, with it all of the outline has to be.
[[nodiscard]] ExcavatorBody read_outline(TomlReader& reader);

/// What is not told is of sensors as Kim et al. have them.
[[nodiscard]] FenceProfile read_fence_margins(TomlReader& reader);

}  // namespace graben::machines
