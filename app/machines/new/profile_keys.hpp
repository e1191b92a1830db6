// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The keys of a profile that is there.

#include <vector>

#include "app/machines/profile_document.hpp"
#include "app/machines/toml_reader.hpp"

namespace graben::machines {

/// What the reader of its kind asks for, with help, unit and range, each key once. Throws
/// ProfileError with every error found.
[[nodiscard]] std::vector<KeyEntry> profile_keys(const ProfileDocument& document);

}  // namespace graben::machines
