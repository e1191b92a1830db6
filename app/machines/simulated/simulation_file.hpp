// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Files of simulated excavators by themselves, and which of them a run takes.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "app/machines/simulated/simulated_excavator.hpp"

namespace graben::machines {

/// Reads and checks NAME.sim.toml with the machine that it is of: the one that its key `machine`
/// names, whose own simulation file it then only differs from, else NAME.toml beside it. Profile
/// and hash are that machine's. Throws as load_simulated_excavator.
[[nodiscard]] SimulatedExcavator load_simulation(const std::filesystem::path& simulation);

/// NAME.sim.toml by its path, by NAME among the shipped ones, or by the profile beside it. Throws
/// std::runtime_error that says where it looked.
[[nodiscard]] std::filesystem::path find_simulation(const std::string& name);

/// Which simulated machine a run has, whatever its controller's profile says.
struct SimulatedChoice {
  std::optional<std::string> name;      ///< As find_simulation; else the profile's own.
  std::optional<std::uint64_t> hidden;  ///< Seed of hidden_machine() on that.

  [[nodiscard]] bool is_own() const { return !name && !hidden; }
};

/// The controller with this profile, in the machine that is chosen. The plant's nominal figures are
/// those of the machine that its file is of, never this profile's; the bus knows both by the hash
/// of this profile. Throws as load_simulated_excavator, and std::runtime_error where the machine
/// has other drives or pumps than the profile.
[[nodiscard]] SimulatedExcavator load_simulated_excavator(const std::filesystem::path& profile,
                                                          const SimulatedChoice& choice);

}  // namespace graben::machines
