// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Which machine a log is of: its controller says a hash of the profile that it was given.

#include <cstdint>
#include <optional>
#include <string>

namespace graben::runs {

struct LoggedMachine {
  std::string profile;  ///< Shipped name, or as it was told.
  std::string bus;      ///< Shipped bus profile that the profile was put on; empty: none.
};

/// The shipped profile, or the one that is told beside them (empty: none), of this hash, by itself
/// or on a shipped bus or the one that is told. None where no one has it. Throws as load_any() and
/// load_bus() of those that are told.
[[nodiscard]] std::optional<LoggedMachine> machine_of_hash(std::uint32_t hash,
                                                           const std::string& told = "",
                                                           const std::string& told_bus = "");

/// "excavator_12t", "excavator_12t on bus zx200"; the hash of any that is not shipped.
[[nodiscard]] std::string machine_words(std::uint32_t hash, const std::string& told,
                                        const std::string& told_bus = "");

}  // namespace graben::runs
