// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The sections of a dozer's TOML file.

#include "app/machines/toml_reader.hpp"
#include "firmware/dozer/dozer_profile.hpp"

namespace graben::machines {

/// All that the controller knows: body, blade, flows, transmission, travel, grade, watches.
[[nodiscard]] DozerProfile read_dozer_sections(TomlReader& reader);

/// Checks that need more than one key: the blade's linkage closes over its whole reach, the engine
/// is within its range, the grade can be driven and rounded. They are made only where each key by
/// itself is right.
void check_dozer_across_keys(TomlReader& reader, const DozerProfile& profile);

/// Of the design's corners, over its plane; m.
[[nodiscard]] double lowest_point_m(const GradeDesign& grade);

}  // namespace graben::machines
