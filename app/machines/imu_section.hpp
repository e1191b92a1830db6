// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Section [imu] of an excavator's profile: IMUs on its links in the place of stroke sensors.

#include "app/machines/toml_reader.hpp"
#include "firmware/excavator/excavator_profile.hpp"

namespace graben::machines {

/// None without the section. An error for two IMUs of one address, a stroke sensor's zero beside
/// them, or a section that does not name what stands in for counter and CRC.
[[nodiscard]] ImuProfile read_imus(TomlReader& reader);

/// IMUs of a machine that is to have them though its profile says nothing of it: one in the middle
/// of each link, along it, and figures of the class. The fences then allow for what they are off.
void fit_usual_imus(ExcavatorProfile& profile);

}  // namespace graben::machines
