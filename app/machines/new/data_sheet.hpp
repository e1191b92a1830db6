// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a data sheet begins with: operating weight, blade width, pumps and their kind, swing. Of it
/// follows which machine a profile begins with, and by how much what is not asked is larger.

#include "app/machines/new/new_profile.hpp"

namespace graben::machines {

// Keys of these questions; no keys of a profile.
inline constexpr const char* kWeightKey = "operating_weight";
inline constexpr const char* kBladeWidthKey = "blade_width";
inline constexpr const char* kPumpCountKey = "pump_count";
inline constexpr const char* kPumpKindKey = "pump_kind";
inline constexpr const char* kSwingKey = "swing_pump";

/// In the order of asking, with what `like` has.
[[nodiscard]] std::vector<ProfileQuestion> sheet_questions(const ProfileDocument& like);

/// `like` with the pumps, their kind and the swing drive that were told: those of the shipped
/// profiles, by the machines' size. Throws std::runtime_error where none of them has it.
[[nodiscard]] ProfileDocument with_structure(const ProfileDocument& like,
                                             const ProfileAnswers& answers);

/// The simulation beside `like`, with the swing drive that `structured` has; none: there is none.
[[nodiscard]] std::optional<ProfileDocument> simulation_of(const ProfileDocument& like,
                                                           const ProfileDocument& structured);

}  // namespace graben::machines
