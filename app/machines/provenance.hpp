// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Where a profile's values are from: its section [provenance].

#include <optional>
#include <string>
#include <vector>

namespace graben::machines {

/// Of one value.
struct Provenance {
  std::string key;                  ///< Path as in TOML: "valve.answer.boom.extend.dead_time".
  std::optional<double> deviation;  ///< Standard deviation, in the unit of the value.
  std::string from;                 ///< Log and its hash, date, method; empty: not said.
};

}  // namespace graben::machines
