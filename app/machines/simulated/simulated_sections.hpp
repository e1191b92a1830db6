#pragma once
/// What the TOML files of all simulated machines have in common.

#include <filesystem>
#include <string>

#include "app/machines/profile_document.hpp"

namespace graben::machines {

/// NAME.sim.toml beside this machine's NAME.toml. Throws std::runtime_error that names the file and
/// what it is for if it is not there, else as read_document.
[[nodiscard]] ProfileDocument read_simulation(const std::filesystem::path& file);

/// Oil and spool of the simulated valve, in section `valve`.
template <class Plant>
void read_valve_of_plant(TomlReader& reader, const std::string& valve, Plant& plant) {
  plant.spool_time_constant_s =
      reader.number(valve + ".time_constant", {0.001, 1.0, "s"},
                    "spool: 1 / natural frequency of its second-order lag");
  plant.spool_damping =
      reader.number(valve + ".damping", {0.1, 10.0, ""}, "damping ratio of that lag");
  plant.deadband_ratio = reader.number(valve + ".deadband", {0.0, 0.9, ""},
                                       "spool's deadband, of its travel, each side");
  plant.bulk_modulus_pa =
      reader.number(valve + ".bulk_modulus", {1e8, 1e11, "Pa"}, "oil with its hoses");
}

}  // namespace graben::machines
