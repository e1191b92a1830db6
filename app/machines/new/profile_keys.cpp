// SPDX-License-Identifier: Apache-2.0
#include "app/machines/new/profile_keys.hpp"

#include "app/machines/answer_section.hpp"
#include "app/machines/dozer_sections.hpp"
#include "app/machines/excavator_sections.hpp"

namespace graben::machines {

std::vector<KeyEntry> profile_keys(const ProfileDocument& document) {
  const MachineKind kind = profile_kind(document);
  std::vector<KeyEntry> keys;
  static_cast<void>(read_as(document, kind, [&](TomlReader& reader) {
    if (kind == MachineKind::kDozer) {
      const DozerProfile profile = read_dozer_sections(reader);
      static_cast<void>(reader.provenance());
      check_dozer_across_keys(reader, profile);
    } else {
      const ExcavatorProfile profile = read_excavator_sections(reader);
      static_cast<void>(read_driven(reader, profile.drive_count));
      static_cast<void>(reader.provenance());
      check_excavator_across_keys(reader, profile);
    }
    keys = reader.keys();
  }));
  return keys;
}

}  // namespace graben::machines
