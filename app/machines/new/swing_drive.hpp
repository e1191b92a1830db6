// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A swing drive of a machine's pumps, put into a new profile and its simulation, or taken out.

#include "app/machines/new/new_profile.hpp"

namespace graben::machines {

[[nodiscard]] bool has_swing(const ProfileDocument& like);

/// A number, or each of a list.
void scale_values(toml::table& table, const char* key, double factor);

/// The shipped machine's that has one, by the operating weight in t: torque and what turns grow
/// faster than areas and flows.
void add_swing(toml::table& root, double weight_t);
void remove_swing(toml::table& root);
/// The same of the simulation's file; what can't swing has its line straight ahead.
void add_simulated_swing(toml::table& root, double weight_t);
void remove_simulated_swing(toml::table& root);

}  // namespace graben::machines
