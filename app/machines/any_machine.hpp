// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A machine's profile, whatever its kind.

#include <filesystem>
#include <variant>

#include "app/machines/dozer_file.hpp"
#include "app/machines/excavator_file.hpp"

namespace graben::machines {

using AnyMachine = std::variant<ExcavatorMachine, DozerMachine>;

/// As load_excavator or load_dozer, whichever the file's `kind` asks for; the file is read once.
[[nodiscard]] AnyMachine load_any(const std::filesystem::path& file);

}  // namespace graben::machines
