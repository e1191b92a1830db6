#pragma once
/// What each fault does: the one table of reactions.

#include <cstdint>

#include "firmware/core/codes.hpp"
#include "firmware/core/fault_set.hpp"
#include "firmware/signals/machine_signals.hpp"

namespace graben {

enum class Reaction : std::uint8_t {
  kNone = 0,
  /// In motion: the function is replaced by the worst case and the field is slowed. Not in motion:
  /// as kStop, because arming wants everything.
  kDegrade = 1,
  /// Neutral in the same cycle, enable withdrawn; in motion it stays until the operator re-arms.
  kStop = 2,
};

struct FaultRow {
  Fault fault = Fault::kNone;
  Reaction reaction = Reaction::kNone;
  std::uint8_t fmi = 0;                     ///< Failure mode identifier of SAE J1939-73.
  bool red_stop = false;                    ///< Lamp: red stop; else amber warning.
  ArmBlock block = ArmBlock::kUnreachable;  ///< Shown to the operator while it is there.
};

/// The row of a fault; that of kNone for a number that is none.
[[nodiscard]] const FaultRow& fault_row(Fault fault);

/// Whether the pilot pressure has to go: the spools themselves do not obey.
[[nodiscard]] bool cuts_pilot(Fault fault);
/// The same of any of them.
[[nodiscard]] bool cuts_pilot(const FaultSet& faults);

}  // namespace graben
