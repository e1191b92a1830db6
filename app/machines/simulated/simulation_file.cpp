// SPDX-License-Identifier: Apache-2.0
#include "app/machines/simulated/simulation_file.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "app/machines/profile_document.hpp"
#include "app/machines/simulated/hidden.hpp"
#include "app/machines/simulated/simulated_sections.hpp"

namespace graben::machines {
namespace {

namespace fs = std::filesystem;

/// NAME.toml beside NAME.sim.toml.
fs::path machine_file(const fs::path& simulation) {
  return fs::path(simulation).replace_extension().replace_extension(".toml");
}

std::string name_of(const fs::path& simulation) { return machine_file(simulation).stem().string(); }

/// The machine that the file names; what is wrong with the key is found when all are read.
std::optional<std::string> named_machine(const ProfileDocument& document) {
  return document.root["machine"].value<std::string>();
}

void read_simulation_into(SimulatedExcavator& machine, const ProfileDocument& document) {
  read_as(document, MachineKind::kExcavator,
          [&](TomlReader& reader) { read_simulated_sections(reader, machine); });
}

/// The file's differences over what the machine's own file says, which is checked by itself first:
/// what is wrong afterwards is wrong in the differences.
ProfileDocument over_machine(ProfileDocument differences, const fs::path& profile,
                             SimulatedExcavator machine) {
  ProfileDocument whole = read_simulation(profile);
  if (whole.root.contains("machine")) {
    throw ProfileError(
        differences.file.string(),
        {fmt::format("machine: {} names a machine itself; allowed: one that does not",
                     whole.file.string())});
  }
  read_simulation_into(machine, whole);
  lay_over(whole.root, std::move(differences.root));
  whole.file = differences.file;
  return whole;
}

void check_alike(const fs::path& profile, const ExcavatorProfile& controller,
                 const SimulatedExcavator& machine) {
  const ExcavatorProfile& nominal = machine.profile;
  if (controller.drive_count != nominal.drive_count ||
      controller.pump_count != nominal.pump_count) {
    throw std::runtime_error(
        fmt::format("{}: {} drives and {} pumps; the simulated machine, {}, has {} and {}",
                    profile.string(), controller.drive_count, controller.pump_count, machine.name,
                    nominal.drive_count, nominal.pump_count));
  }
}

}  // namespace

SimulatedExcavator load_simulation(const fs::path& simulation) {
  ProfileDocument document = read_document(simulation);
  const std::optional<std::string> named = named_machine(document);
  const fs::path profile =
      named ? find_machine(*named, simulation.parent_path()) : machine_file(simulation);
  SimulatedExcavator machine;
  static_cast<ExcavatorMachine&>(machine) = load_excavator(profile);
  if (named) {
    document = over_machine(std::move(document), profile, machine);
  }
  read_simulation_into(machine, document);
  return machine;
}

SimulatedExcavator load_simulated_excavator(const fs::path& file) {
  ExcavatorMachine controller = load_excavator(file);
  const ProfileDocument document = read_simulation(file);
  SimulatedExcavator machine;
  if (named_machine(document)) {
    machine = load_simulation(document.file);
    check_alike(file, controller.profile, machine);
  }
  static_cast<ExcavatorMachine&>(machine) = std::move(controller);
  if (!named_machine(document)) {
    read_simulation_into(machine, document);
  }
  return machine;
}

fs::path find_simulation(const std::string& name) {
  const fs::path file(name);
  if (fs::is_regular_file(file)) {
    return is_simulation_file(file) ? file : simulation_file(file);
  }
  return find_shipped_simulation(name);
}

SimulatedExcavator load_simulated_excavator(const fs::path& profile,
                                            const SimulatedChoice& choice) {
  SimulatedExcavator machine;
  if (choice.name) {
    const fs::path simulation = find_simulation(*choice.name);
    ExcavatorMachine controller = load_excavator(profile);
    machine = load_simulation(simulation);
    check_alike(profile, controller.profile, machine);
    static_cast<ExcavatorMachine&>(machine) = std::move(controller);
    machine.simulated = name_of(simulation);
  } else {
    machine = load_simulated_excavator(profile);
  }
  if (choice.hidden) {
    machine = hidden_machine(machine, *choice.hidden);
    machine.simulated +=
        fmt::format("{}hidden {}", machine.simulated.empty() ? "" : " ", *choice.hidden);
  }
  return machine;
}

}  // namespace graben::machines
