// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The reference of all keys of profiles, made of what the readers ask for.

#include <string>

namespace graben::machines {

/// Markdown: a table a file and section, of key, meaning, unit, allowed values, default.
[[nodiscard]] std::string key_reference();

}  // namespace graben::machines
