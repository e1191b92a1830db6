// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Parameter groups of SAE J1939 that diagnosis needs, and the 29-bit ids that they are sent with.

#include <cstdint>

namespace graben::j1939 {

inline constexpr std::uint32_t kRequestPgn = 0xEA00;         ///< 59904
inline constexpr std::uint32_t kAcknowledgmentPgn = 0xE800;  ///< 59392
inline constexpr std::uint32_t kConnectionPgn = 0xEC00;      ///< 60416, TP.CM
inline constexpr std::uint32_t kDataTransferPgn = 0xEB00;    ///< 60160, TP.DT
inline constexpr std::uint32_t kActiveCodesPgn = 0xFECA;     ///< 65226, DM1
inline constexpr std::uint32_t kPreviousCodesPgn = 0xFECB;   ///< 65227, DM2
inline constexpr std::uint32_t kAddressClaimedPgn = 0xEE00;  ///< 60928
inline constexpr std::uint32_t kClearPreviousPgn = 0xFECC;   ///< 65228, DM3
inline constexpr std::uint32_t kClearActivePgn = 0xFED3;     ///< 65235, DM11
inline constexpr std::uint32_t kSupportPgn = 0xFDB6;         ///< 64950, DM24
inline constexpr std::uint32_t kFreezeFramePgn = 0xFDB7;     ///< 64951, DM25

inline constexpr std::uint8_t kGlobalAddress = 0xFF;
inline constexpr std::uint8_t kNullAddress = 0xFE;
inline constexpr std::uint32_t kDiagnosticPriority = 6;
inline constexpr std::uint32_t kTransportPriority = 7;

/// The id of a group; of one for a single receiver (PDU1) `pgn` has 0 where that stands.
constexpr std::uint32_t id_of(std::uint32_t priority, std::uint32_t pgn, std::uint8_t receiver,
                              std::uint8_t sender) {
  const bool is_pdu1 = (pgn >> 8U & 0xFFU) < 240U;
  return priority << 26U | (pgn | (is_pdu1 ? receiver : 0U)) << 8U | sender;
}

/// What is read from an id.
struct Address {
  std::uint32_t pgn = 0;
  std::uint8_t receiver = kGlobalAddress;
  std::uint8_t sender = 0;
};

constexpr Address address_of(std::uint32_t id) {
  const std::uint32_t group = id >> 8U & 0x3FFFFU;
  const auto low = static_cast<std::uint8_t>(group);
  const bool is_pdu1 = (group >> 8U & 0xFFU) < 240U;
  return {is_pdu1 ? group & 0x3FF00U : group, is_pdu1 ? low : kGlobalAddress,
          static_cast<std::uint8_t>(id)};
}

}  // namespace graben::j1939
