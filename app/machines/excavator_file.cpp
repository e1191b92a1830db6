// SPDX-License-Identifier: Apache-2.0
#include "app/machines/excavator_file.hpp"

#include "app/machines/excavator_sections.hpp"
#include "app/machines/profile_document.hpp"

namespace graben::machines {

ExcavatorMachine load_excavator(const ProfileDocument& document) {
  ExcavatorMachine machine;
  machine.name = document.file.stem().string();
  machine.hash = read_as(document, MachineKind::kExcavator, [&](TomlReader& reader) {
    machine.profile = read_excavator_sections(reader);
    machine.driven = read_driven(reader, machine.profile.drive_count);
    machine.provenance = reader.provenance();
    check_excavator_across_keys(reader, machine.profile);
  });
  return machine;
}

ExcavatorMachine load_excavator(const std::filesystem::path& file) {
  return load_excavator(read_document(file));
}

}  // namespace graben::machines
