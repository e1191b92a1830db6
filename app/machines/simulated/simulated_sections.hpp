// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the TOML files of all simulated machines have in common.

#include <filesystem>
#include <string>

#include "app/machines/profile_document.hpp"

namespace graben::machines {

/// NAME.sim.toml beside this machine's NAME.toml. Throws std::runtime_error that names the file and
/// what it is for if it is not there, else as read_document.
[[nodiscard]] ProfileDocument read_simulation(const std::filesystem::path& file);

/// Oil and spools of a simulated valve.
struct ValveOfPlant {
  double time_constant_s = 0.0;
  double damping = 1.0;
  double deadband_ratio = 0.0;  ///< Of the travel, each side.
  double bulk_modulus_pa = 0.0;
};

/// In section `valve`.
[[nodiscard]] ValveOfPlant read_valve_of_plant(TomlReader& reader, const std::string& valve);

struct Interval {
  double least = 0.0;
  double most = 0.0;
};

/// Two numbers, the smaller one first.
[[nodiscard]] Interval read_interval(TomlReader& reader, const std::string& key, const Range& range,
                                     const char* help);

}  // namespace graben::machines
