// SPDX-License-Identifier: Apache-2.0
#pragma once
/// `graben commission` of a simulated dozer.

#include <cstdint>
#include <optional>
#include <string>

#include "app/cli/commission_on_bus.hpp"

namespace graben::cli {

struct DozerCommission {
  const BusCommission& options;
  std::optional<std::uint64_t> hidden;  ///< Seed of a machine that nobody has described.
  std::optional<std::uint64_t> seed;    ///< Of the sensors' noise; without it they have none.
  bool force = false;                   ///< The log may be there already.
};

/// Throws std::runtime_error, with the reason, unless all is done in the end.
void commission_dozer(const DozerCommission& of);

}  // namespace graben::cli
