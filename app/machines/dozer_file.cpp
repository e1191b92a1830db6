// SPDX-License-Identifier: Apache-2.0
#include "app/machines/dozer_file.hpp"

#include "app/machines/design_file.hpp"
#include "app/machines/dozer_sections.hpp"
#include "app/machines/profile_document.hpp"
#include "app/machines/unknown_drives.hpp"

namespace graben::machines {

DozerMachine load_dozer(const ProfileDocument& document) {
  DozerMachine machine;
  machine.name = document.file.stem().string();
  const std::uint32_t of_keys = read_as(document, MachineKind::kDozer, [&](TomlReader& reader) {
    machine.profile = read_dozer_sections(reader);
    machine.driven = read_dozer_driven(reader, machine.profile.tilt.present);
    machine.provenance = reader.provenance();
    if (reader.has(kDesignKey) && reader.is_sound()) {
      const DesignLine line = read_design(document.file.parent_path() / design_name(reader));
      set_design(machine, heights_of(line, machine.profile.grade.rounding_m));
    }
    check_dozer_across_keys(reader, machine.profile);
  });
  machine.hash ^= of_keys;  // With what a design in a file of its own has put there.
  refuse_unknown(machine);
  return machine;
}

DozerMachine load_dozer(const std::filesystem::path& file) {
  const ProfileDocument document = read_document(file);
  refuse_other_sort(document, kMachineSort);
  return load_dozer(document);
}

}  // namespace graben::machines
