#pragma once
/// A pose of the teeth as profiles and tasks write it: { position = [x, y, z], attitude = a }.

#include <string>

#include "app/machines/toml_reader.hpp"
#include "firmware/excavator/kinematics/swing_kinematics.hpp"

namespace graben::machines {

/// m and rad, in the ground frame of the swing axis.
[[nodiscard]] TeethPose read_teeth(TomlReader& reader, const std::string& at);

}  // namespace graben::machines
