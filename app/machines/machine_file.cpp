#include "app/machines/machine_file.hpp"

#include <fmt/format.h>

#include "app/machines/excavator_sections.hpp"
#include "app/machines/profile_document.hpp"

namespace graben::machines {

ProfileError::ProfileError(const std::string& file, std::vector<std::string> errors)
    : std::runtime_error(fmt::format("{}: {} error{}:\n  {}", file, errors.size(),
                                     errors.size() == 1 ? "" : "s", fmt::join(errors, "\n  "))),
      errors_(std::move(errors)) {}

std::filesystem::path find_profile(const std::string& name,
                                   const std::vector<std::filesystem::path>& folders) {
  if (std::filesystem::is_regular_file(name)) {
    return name;
  }
  std::string looked_in;
  for (const std::filesystem::path& folder : folders) {
    for (const std::filesystem::path& candidate : {folder / name, folder / (name + ".toml")}) {
      if (std::filesystem::is_regular_file(candidate)) {
        return candidate;
      }
    }
    looked_in += (looked_in.empty() ? "" : ", ") + folder.string();
  }
  throw std::runtime_error(
      fmt::format("profile '{}' not found, neither as a file nor in {}", name, looked_in));
}

ExcavatorMachine load_excavator(const std::filesystem::path& file) {
  return load_machine<ExcavatorMachine>(
      file, MachineKind::kExcavator, [](TomlReader& reader, ExcavatorMachine& machine) {
        machine.profile = read_controller_sections(reader);
        machine.plant = read_plant_sections(reader, machine.profile);
        machine.experiment = read_experiment_sections(reader, machine.profile.dig_path);
        check_across_keys(reader, machine.profile, machine.experiment);
      });
}

}  // namespace graben::machines
