// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The sections of an excavator's TOML files, and keys that several of them have.

#include <array>
#include <optional>
#include <string>

#include "app/machines/bus_key.hpp"
#include "app/machines/toml_reader.hpp"
#include "firmware/excavator/excavator_controller.hpp"
#include "firmware/excavator/excavator_profile.hpp"
#include "firmware/excavator/kinematics/swing_kinematics.hpp"

namespace graben::machines {

/// All that the controller knows: geometry, pumps, valve, control, safety, task.
[[nodiscard]] ExcavatorProfile read_excavator_sections(
    TomlReader& reader, const std::vector<KnownBus>& buses = known_buses());

/// Checks that need more than one key: the path lies in the work space, angle ranges fit the stroke
/// ends, orifices and tables fit each other. They are made only where each key by itself is right.
void check_excavator_across_keys(TomlReader& reader, const ExcavatorProfile& profile);

/// Least and most joint angle of boom, arm and bucket, rad, that the pins and the ends of the
/// strokes give; none where a linkage does not close there.
[[nodiscard]] std::optional<std::array<std::array<double, 2>, kAxisCount>> joint_ranges(
    const ExcavatorGeometry& geometry);

/// A path at this key.
[[nodiscard]] DigPath read_path(TomlReader& reader, const std::string& at);
/// An error at this key where a checked profile's path leaves the work space.
void check_path(TomlReader& reader, const char* key, const ProfileCheck& check);

/// A pose of the teeth, { position = [x, y, z], attitude = a }: m and rad, in the ground frame of
/// the swing axis.
[[nodiscard]] TeethPose read_teeth(TomlReader& reader, const std::string& at);

}  // namespace graben::machines
