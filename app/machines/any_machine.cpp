// SPDX-License-Identifier: Apache-2.0
#include "app/machines/any_machine.hpp"

#include "app/machines/profile_document.hpp"

namespace graben::machines {

AnyMachine load_any(const std::filesystem::path& file) {
  const ProfileDocument document = read_document(file);
  refuse_other_sort(document, kMachineSort);
  if (profile_kind(document) == MachineKind::kDozer) {
    return load_dozer(document);
  }
  return load_excavator(document);
}

}  // namespace graben::machines
