// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Reactions to faults: the rows of faults.toml as the core needs them.

#include <cstdint>

#include "firmware/core/codes.hpp"
#include "firmware/core/fault_set.hpp"

namespace graben {

enum class Reaction : std::uint8_t {
  kNone = 0,
  /// In motion: the function is replaced by the worst case and the field is slowed. Not in motion:
  /// as kStop, because arming wants everything.
  kDegrade = 1,
  /// Neutral in the same cycle, enable withdrawn; in motion it stays until the operator re-arms.
  kStop = 2,
  /// Said and shown; the machine goes on as it is.
  kWarn = 3,
};

struct FaultRow {
  Fault fault = Fault::kNone;
  Reaction reaction = Reaction::kNone;
  std::uint8_t fmi = 0;                     ///< Failure mode identifier of SAE J1939-73.
  bool red_stop = false;                    ///< Lamp: red stop; else amber warning.
  bool cuts_pilot = false;                  ///< The spools themselves do not obey.
  ArmBlock block = ArmBlock::kUnreachable;  ///< Shown to the operator while it is there.
};

/// The row of a fault; that of kNone for a number that is none.
[[nodiscard]] const FaultRow& fault_row(Fault fault);

/// True if the pilot pressure has to go.
[[nodiscard]] bool cuts_pilot(Fault fault);
/// The same of any of them.
[[nodiscard]] bool cuts_pilot(const FaultSet& faults);
/// True if any of them lights the lamp.
[[nodiscard]] bool has_red_stop(const FaultSet& faults);
[[nodiscard]] bool has_amber_warning(const FaultSet& faults);

}  // namespace graben
