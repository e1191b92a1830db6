// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The excavator's profile: TOML in, checked as a whole, const structs out.

#include <cstdint>
#include <filesystem>
#include <string>

#include "app/machines/answer_section.hpp"
#include "app/machines/profile_file.hpp"
#include "firmware/excavator/excavator_profile.hpp"
#include "hal/buses/bus_table.hpp"

namespace graben::machines {

/// An excavator as its controller has to know it.
struct ExcavatorMachine {
  std::string name;        ///< File name without its ending.
  std::uint32_t hash = 0;  ///< Of the checked values (TomlReader::hash); on the bus as ProfileHash.
  ExcavatorProfile profile;
  std::array<DrivenRanges, kDriveCount> driven;  ///< How far the spools' answers are known.
  std::vector<Provenance> provenance;            ///< Where its values are from, as far as said.
  BusTable bus;                                  ///< Of the bus that it is on; empty: ours.
  std::string bus_speaks;                        ///< Whose bus that is; empty: ours.
};

/// Reads and checks an excavator's profile. Throws ProfileError with every error found.
[[nodiscard]] ExcavatorMachine load_excavator(const std::filesystem::path& file);
[[nodiscard]] ExcavatorMachine load_excavator(const ProfileDocument& document);

/// As if its profile named this bus profile, a file or a shipped one, and every stand-in for what
/// that lacks. Throws std::runtime_error where it can't be on it.
void put_on_bus(const std::string& name, ExcavatorMachine& machine);

}  // namespace graben::machines
