// SPDX-License-Identifier: Apache-2.0
#include "hal/j1939/trouble_codes.hpp"

#include <algorithm>

#include "firmware/safety/fault_table.hpp"
#include "hal/link/dm1.hpp"

namespace graben::j1939 {
namespace {

constexpr unsigned kAmberBit = 2;
constexpr unsigned kRedBit = 4;
constexpr std::size_t kMostCodeBytes = 2 + 4 * kMostCodes;
constexpr std::uint8_t kNoFlashing = 0xFF;

/// Smaller is more urgent; 3 of them.
int urgency(Fault fault) {
  const FaultRow& row = fault_row(fault);
  if (row.red_stop || row.reaction == Reaction::kStop) {
    return 0;
  }
  return row.reaction == Reaction::kDegrade ? 1 : 2;
}

void put_code(LongMessage& message, Fault fault, std::uint8_t occurrences) {
  const std::array<std::uint8_t, 4> code = code_bytes(fault, occurrences);
  std::copy(code.begin(), code.end(), message.bytes.begin() + message.size);
  message.size = static_cast<std::uint16_t>(message.size + code.size());
}

}  // namespace

int count_of(const FaultSet& faults) {
  int count = 0;
  for (Fault fault = faults.first(); fault != Fault::kNone; fault = faults.after(fault)) {
    ++count;
  }
  return count;
}

std::array<std::uint8_t, 4> code_bytes(Fault fault, std::uint8_t occurrences) {
  const std::uint32_t spn = kDm1FirstSpn + static_cast<std::uint32_t>(fault);
  return {static_cast<std::uint8_t>(spn), static_cast<std::uint8_t>(spn >> 8U),
          static_cast<std::uint8_t>((spn >> 16U & 0x07U) << 5U | (fault_row(fault).fmi & 0x1FU)),
          std::clamp<std::uint8_t>(occurrences, 1, kDm1MaxOccurrences)};
}

LongMessage trouble_codes(std::uint32_t pgn, const FaultSet& faults, const FaultSet& lit,
                          const Occurrences& occurrences) {
  LongMessage message;
  message.pgn = pgn;
  unsigned lamps = 0;
  for (Fault fault = lit.first(); fault != Fault::kNone; fault = lit.after(fault)) {
    lamps |= 1U << (fault_row(fault).red_stop ? kRedBit : kAmberBit);
  }
  message.bytes[0] = static_cast<std::uint8_t>(lamps);
  message.bytes[1] = kNoFlashing;
  message.size = 2;
  for (int rank = 0; rank < 3; ++rank) {
    for (Fault fault = faults.first(); fault != Fault::kNone; fault = faults.after(fault)) {
      if (urgency(fault) == rank && message.size + 4U <= kMostCodeBytes) {
        put_code(message, fault, occurrences[static_cast<std::size_t>(fault)]);
      }
    }
  }
  if (message.size <= 6) {
    // None is four bytes of 0.
    message.bytes[6] = message.bytes[7] = kNoFlashing;
    message.size = 8;
  }
  return message;
}

}  // namespace graben::j1939
