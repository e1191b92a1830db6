// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The sections of a dozer's TOML file.

#include <string>
#include <vector>

#include "app/machines/toml_reader.hpp"
#include "firmware/dozer/dozer_profile.hpp"

namespace graben::machines {

/// All that the controller knows: body, blade, flows, transmission, travel, grade, watches.
[[nodiscard]] DozerProfile read_dozer_sections(TomlReader& reader);

/// Names the file of a design that stands in the place of `grade.profile`.
inline constexpr const char* kDesignKey = "grade.design";
[[nodiscard]] std::string design_name(TomlReader& reader);

/// Checks that need more than one key: the blade's linkage closes over its whole reach, the engine
/// is within its range, the grade can be driven and rounded. They are made only where each key by
/// itself is right.
void check_dozer_across_keys(TomlReader& reader, const DozerProfile& profile);

/// Why this machine can't make the design, and the key that it concerns: too steep, corners that
/// are too near, out of the blade's reach, tipping faster than the blade follows. One at least is
/// all that it looks for.
struct DesignError {
  std::string key;
  std::string what;
};
[[nodiscard]] std::vector<DesignError> design_errors(const DozerProfile& profile);

/// Of the design, over its plane; m.
[[nodiscard]] double lowest_point_m(const GradeDesign& grade);

}  // namespace graben::machines
