// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Section [second] of an excavator's profile: second sensors of its joints.

#include "app/machines/toml_reader.hpp"
#include "firmware/excavator/excavator_profile.hpp"

namespace graben::machines {

/// None without the section. An error for one that names no joint, or a swing that is not there.
[[nodiscard]] SecondSensors read_seconds(TomlReader& reader, bool has_swing);

/// Second sensors on every joint of a machine that is to have them though its profile says nothing
/// of it, with figures of the class.
void fit_usual_seconds(ExcavatorProfile& profile);

}  // namespace graben::machines
