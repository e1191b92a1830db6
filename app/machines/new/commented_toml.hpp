// SPDX-License-Identifier: Apache-2.0
#pragma once
/// TOML written newly, every key with a comment on what it is.

#include <toml++/toml.h>

#include <map>
#include <string>
#include <vector>

#include "app/machines/toml_reader.hpp"

namespace graben::machines {

/// In the place of what a table has: numbers, or rows of them; and where they are from.
struct CommentedValue {
  std::vector<double> numbers;
  std::vector<std::vector<double>> rows;
  std::string from;
};
using CommentedValues = std::map<std::string, CommentedValue>;  ///< By key path.

/// `root` in the order of its source, section after section, with the values of `told` instead of
/// its own. Above each key its help, unit and range as `keys` have them; beside it where the value
/// is from, `otherwise` unless told.
[[nodiscard]] std::string commented_toml(const toml::table& root, const std::vector<KeyEntry>& keys,
                                         const CommentedValues& told, const std::string& otherwise);

}  // namespace graben::machines
