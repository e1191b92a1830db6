// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What measures an excavator's joints, as its profile says it.

#include "firmware/excavator/excavator_profile.hpp"

namespace graben::machines {

class TomlReader;

/// Zeros of stroke and pressure sensors, each 0 where nothing is said, the IMUs, and second
/// sensors.
void read_joint_sensors(TomlReader& reader, ExcavatorProfile& profile);

}  // namespace graben::machines
