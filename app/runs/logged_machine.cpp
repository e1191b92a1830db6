// SPDX-License-Identifier: Apache-2.0
#include "app/runs/logged_machine.hpp"

#include <fmt/format.h>

#include <utility>
#include <variant>
#include <vector>

#include "app/machines/any_machine.hpp"
#include "app/machines/bus_file.hpp"
#include "app/machines/profile_file.hpp"

namespace graben::runs {

std::optional<LoggedMachine> machine_of_hash(std::uint32_t hash, const std::string& told,
                                             const std::string& told_bus) {
  std::vector<std::string> names = machines::shipped_profile_names();
  if (!told.empty()) {
    names.push_back(told);
  }
  std::vector<std::pair<std::string, std::uint32_t>> profiles;
  for (const std::string& name : names) {
    const machines::AnyMachine machine = machines::load_any(machines::find_profile(name));
    const std::uint32_t its = std::visit([](const auto& any) { return any.hash; }, machine);
    if (its == hash) {
      return LoggedMachine{name, ""};
    }
    profiles.emplace_back(name, its);
  }
  // A profile that is put on a bus has both hashes over each other.
  std::vector<std::string> buses = machines::shipped_bus_names();
  if (!told_bus.empty()) {
    buses.push_back(told_bus);
  }
  for (const std::string& bus : buses) {
    const std::uint32_t of_bus = machines::load_bus(machines::find_bus(bus)).hash;
    for (const auto& [name, of_profile] : profiles) {
      if ((of_profile ^ of_bus) == hash) {
        return LoggedMachine{name, bus};
      }
    }
  }
  return std::nullopt;
}

std::string machine_words(std::uint32_t hash, const std::string& told,
                          const std::string& told_bus) {
  const std::optional<LoggedMachine> machine = machine_of_hash(hash, told, told_bus);
  if (!machine) {
    return fmt::format("one that is not shipped ({:08x})", hash);
  }
  return machine->bus.empty() ? machine->profile
                              : fmt::format("{} on bus {}", machine->profile, machine->bus);
}

}  // namespace graben::runs
