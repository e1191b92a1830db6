// SPDX-License-Identifier: Apache-2.0
#include "app/ecu/store/record_format.hpp"

#include "app/ecu/store/byte_order.hpp"

namespace graben::ecu {
namespace {

constexpr std::uint32_t kMagic = 0x52425247;        // "GRBR"
constexpr std::uint32_t kPolynomial = 0xEDB88320U;  // Of IEEE 802.3, the lowest bit first.
constexpr std::size_t kChecksumAt = 28;

constexpr std::array<std::uint32_t, 256> crc_table() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t byte = 0; byte < table.size(); ++byte) {
    std::uint32_t rest = byte;
    for (int bit = 0; bit < 8; ++bit) {
      rest = (rest & 1U) != 0 ? rest >> 1U ^ kPolynomial : rest >> 1U;
    }
    table[byte] = rest;
  }
  return table;
}
constexpr std::array<std::uint32_t, 256> kCrcTable = crc_table();

std::uint32_t checksum(const RecordBytes& record, std::size_t payload_bytes) {
  return crc32(record.data() + kHeadBytes, payload_bytes, crc32(record.data(), kChecksumAt));
}

}  // namespace

std::uint32_t crc32(const std::uint8_t* bytes, std::size_t count, std::uint32_t before) {
  std::uint32_t rest = ~before;
  for (std::size_t i = 0; i < count; ++i) {
    rest = rest >> 8U ^ kCrcTable[(rest ^ bytes[i]) & 0xFFU];
  }
  return ~rest;
}

std::size_t seal_record(const RecordHead& head, RecordBytes& record) {
  ByteWriter to(record.data(), kHeadBytes);
  to.u32(kMagic);
  to.u16(kRecordVersion);
  to.u16(static_cast<std::uint16_t>(head.key.kind));
  to.u16(head.key.index);
  to.u16(0);
  to.u32(head.profile_hash);
  to.u64(head.sequence);
  to.u32(head.length);
  to.u32(checksum(record, head.length));
  return kHeadBytes + head.length;
}

CopyState open_record(const RecordBytes& record, std::size_t count, RecordKey key,
                      RecordHead& head) {
  if (count == 0) {
    return CopyState::kAbsent;
  }
  if (count < kHeadBytes) {
    return CopyState::kDamaged;
  }
  ByteReader from(record.data(), kHeadBytes);
  const std::uint32_t magic = from.u32();
  const std::uint16_t version = from.u16();
  head.key.kind = static_cast<RecordKind>(from.u16());
  head.key.index = from.u16();
  static_cast<void>(from.u16());
  head.profile_hash = from.u32();
  head.sequence = from.u64();
  head.length = from.u32();
  const std::uint32_t sum = from.u32();
  if (magic != kMagic) {
    return CopyState::kDamaged;
  }
  if (version != kRecordVersion) {
    return CopyState::kOtherVersion;
  }
  // A shorter record in the place of a longer one leaves the longer one's end behind it.
  const bool whole = head.length <= kMostPayloadBytes && count >= kHeadBytes + head.length;
  return whole && head.key == key && sum == checksum(record, head.length) ? CopyState::kValid
                                                                          : CopyState::kDamaged;
}

}  // namespace graben::ecu
