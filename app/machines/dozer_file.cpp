// SPDX-License-Identifier: Apache-2.0
#include "app/machines/dozer_file.hpp"

#include "app/machines/dozer_sections.hpp"
#include "app/machines/profile_document.hpp"

namespace graben::machines {

DozerMachine load_dozer(const ProfileDocument& document) {
  DozerMachine machine;
  machine.name = document.file.stem().string();
  machine.hash = read_as(document, MachineKind::kDozer, [&](TomlReader& reader) {
    machine.profile = read_dozer_sections(reader);
    machine.provenance = reader.provenance();
    check_dozer_across_keys(reader, machine.profile);
  });
  return machine;
}

DozerMachine load_dozer(const std::filesystem::path& file) {
  return load_dozer(read_document(file));
}

}  // namespace graben::machines
