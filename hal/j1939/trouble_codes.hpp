// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The content of DM1 and DM2 (J1939-73): two bytes of lamps, four bytes a trouble code, most
/// urgent first. SPN and FMI of a fault are those of hal/link/dm1.hpp.

#include <array>
#include <cstdint>

#include "firmware/core/fault_set.hpp"
#include "hal/j1939/transport.hpp"

namespace graben::j1939 {

/// How often each fault has come; on the bus up to kDm1MaxOccurrences.
using Occurrences = std::array<std::uint8_t, kFaultCount>;

/// How many faults there are.
[[nodiscard]] int count_of(const FaultSet& faults);

/// A trouble code: SPN, FMI, and how often it came, from 1 to kDm1MaxOccurrences.
[[nodiscard]] std::array<std::uint8_t, 4> code_bytes(Fault fault, std::uint8_t occurrences);

/// `faults` as codes: those that stop before those that slow, those before the rest, and of each by
/// their numbers; up to 17. `lit` are the faults that lamps are lit for. Fewer than two codes make
/// 8 bytes, which need no transport.
[[nodiscard]] LongMessage trouble_codes(std::uint32_t pgn, const FaultSet& faults,
                                        const FaultSet& lit, const Occurrences& occurrences);

}  // namespace graben::j1939
