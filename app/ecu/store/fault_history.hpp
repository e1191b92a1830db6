// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What is remembered of each fault, of the operation that it is counted in, what the controller
/// has learnt meanwhile and which place it has left: one record, so that none of it costs a write
/// of its own.

#include <array>
#include <cstddef>
#include <cstdint>

#include "app/ecu/store/learnt_record.hpp"
#include "app/ecu/store/record_format.hpp"
#include "firmware/core/codes.hpp"
#include "firmware/core/fault_set.hpp"

namespace graben::ecu {

struct FaultEntry {
  std::uint32_t occurrences = 0;  ///< 0: it was never there, or has been cleared.
  std::uint32_t first_s = 0;      ///< In seconds of operation.
  std::uint32_t last_s = 0;
  std::uint32_t first_unix_s = 0;  ///< The same since 1970; 0: the clock was not known.
  std::uint32_t last_unix_s = 0;
  std::uint32_t last_cycle = 0;  ///< Number of the power cycle in which it was last there.

  /// Whether a freeze frame of that second of operation can be of these occurrences. One of faults
  /// that came a cycle apart has the first one's time.
  [[nodiscard]] bool covers(std::uint32_t at_s) const {
    return occurrences > 0 && std::uint64_t{at_s} + 1 >= first_s && at_s <= last_s;
  }
};

struct FaultHistory {
  std::uint32_t operation_s = 0;   ///< Of the process, over all power cycles.
  std::uint32_t power_cycles = 0;  ///< That is on; the first is 1.
  std::uint32_t boot = 0;          ///< Mark of the system's start; 0: not known.
  std::uint16_t tokens = 0;        ///< Of the wear budget.
  std::uint32_t lost = 0;          ///< Events and frames for which there was no room.
  std::array<FaultEntry, kFaultCount> entry{};
  // Last, so that a reader that does not know them reads the rest.
  LearntRecord learnt;
  std::uint32_t left_site = 0;  ///< site_mark() of a place that the machine has left; 0: of none.

  [[nodiscard]] FaultEntry& of(Fault fault) { return entry[static_cast<std::size_t>(fault)]; }
  [[nodiscard]] const FaultEntry& of(Fault fault) const {
    return entry[static_cast<std::size_t>(fault)];
  }
  /// Faults with an occurrence.
  [[nodiscard]] int stored() const;
  /// `fault` came at that time of operation.
  void add(Fault fault, std::uint32_t at_s, std::uint32_t at_unix_s);
  /// Goes on from `found`, of the same machine: what this one has is of later occurrences, its
  /// times from 0; `cleared` are those that count from 0. Operation, power cycles and what was lost
  /// become those of `found`.
  void follow(const FaultHistory& found, const FaultSet& cleared);
  /// Power cycles that began since it was last there.
  [[nodiscard]] std::uint32_t cycles_since(Fault fault) const {
    return power_cycles - of(fault).last_cycle;
  }
};

/// The payload of a history; returns its bytes.
std::size_t write_history(const FaultHistory& history, std::uint8_t* payload);
/// False, with nothing to be used in `history`, if these bytes are none.
[[nodiscard]] bool read_history(const std::uint8_t* payload, std::size_t length,
                                FaultHistory& history);

/// A mark of this start of the system, of its boot_id; 0: it has none to be read.
[[nodiscard]] std::uint32_t boot_mark();

}  // namespace graben::ecu
