#include "app/machines/excavator_file.hpp"

#include "app/machines/excavator_sections.hpp"
#include "app/machines/profile_document.hpp"

namespace graben::machines {

ExcavatorMachine load_excavator(const ProfileDocument& document) {
  return load_machine<ExcavatorMachine>(
      document, MachineKind::kExcavator, [](TomlReader& reader, ExcavatorMachine& machine) {
        machine.profile = read_controller_sections(reader);
        machine.plant = read_plant_sections(reader, machine.profile);
        machine.experiment = read_experiment_sections(reader, machine.profile.dig_path);
        check_across_keys(reader, machine.profile, machine.experiment);
      });
}

ExcavatorMachine load_excavator(const std::filesystem::path& file) {
  return load_excavator(read_document(file));
}

}  // namespace graben::machines
