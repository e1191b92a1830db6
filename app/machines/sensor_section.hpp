// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Zeros of an excavator's sensors, as its profile says them.

#include "firmware/excavator/excavator_profile.hpp"

namespace graben::machines {

class TomlReader;

/// Each 0 where nothing is said.
[[nodiscard]] SensorZeros read_sensor_zeros(TomlReader& reader);

}  // namespace graben::machines
