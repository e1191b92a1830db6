// SPDX-License-Identifier: Apache-2.0
#include "hal/buses/bus_table.hpp"

#include "can_dbc/codec.hpp"
#include "hal/buses/canopen_nodes.hpp"

namespace graben {
namespace {

constexpr unsigned kPayloadBits = 64;
constexpr unsigned kByteBits = 8;

/// First byte highest: the order in which Motorola counts on.
std::uint64_t swapped(std::uint64_t word) {
  std::uint64_t other = 0;
  for (unsigned byte = 0; byte < kPayloadBits / kByteBits; ++byte) {
    other = other << kByteBits | (word >> (kByteBits * byte) & 0xFFU);
  }
  return other;
}

/// Bits of a Motorola field before its highest, counted from the payload's begin.
unsigned before(const BitField& field) {
  return kByteBits * (field.start_bit / kByteBits) + (kByteBits - 1U - field.start_bit % kByteBits);
}

std::uint64_t mask_of(const BitField& field) { return (std::uint64_t{1} << field.width) - 1U; }

/// From the lowest bit of the word, which is `swapped` for a Motorola field.
unsigned shift_of(const BitField& field) {
  return field.motorola ? kPayloadBits - before(field) - field.width : field.start_bit;
}

}  // namespace

std::int64_t raw_of(const BitField& field, const std::array<std::uint8_t, 8>& data) {
  const std::uint64_t plain = dbc::word_of(data);
  const std::uint64_t word = field.motorola ? swapped(plain) : plain;
  const std::uint64_t bits = word >> shift_of(field) & mask_of(field);
  const bool negative = field.is_signed && (bits >> (field.width - 1U)) != 0U;
  return static_cast<std::int64_t>(bits) -
         (negative ? static_cast<std::int64_t>(mask_of(field)) + 1 : 0);
}

void put_raw(const BitField& field, std::int64_t raw, std::array<std::uint8_t, 8>& data) {
  const std::uint64_t plain = dbc::word_of(data);
  const std::uint64_t word = field.motorola ? swapped(plain) : plain;
  const std::uint64_t mask = mask_of(field) << shift_of(field);
  const std::uint64_t bits = static_cast<std::uint64_t>(raw) << shift_of(field) & mask;
  const std::uint64_t with = (word & ~mask) | bits;
  data = dbc::payload_of(field.motorola ? swapped(with) : with);
}

bool lies_within(const BitField& field, unsigned length) {
  const unsigned begin = field.motorola ? before(field) : field.start_bit;
  return field.width > 0 && field.width <= 32U && begin + field.width <= kByteBits * length;
}

BusParts with_table(BusParts parts, const BusTable* table) {
  if (table != nullptr && !table->empty()) {
    parts.table = table;
    parts.own_machine = table->own_frames;
    parts.swing_drive = parts.swing_drive && table->own_frames;
    parts.second_swing = parts.second_swing && table->own_frames;
    parts.own_engine = !table->has_engine;
  }
  return parts;
}

TableIds table_ids(const BusTable& table) {
  TableIds ids{};
  for (std::size_t i = 0; i < table.message_count; ++i) {
    ids[i] = table.rule[i].id | (table.rule[i].extended ? 0U : kStandardId);
  }
  for (std::size_t i = 0; i < table.send_count; ++i) {
    ids[kMostTableReceived + i] =
        table.send[i].rule.id | (table.send[i].extended ? 0U : kStandardId);
  }
  for (std::size_t i = 0; i < table.node_count; ++i) {
    const std::size_t at = kMostTableReceived + kMostTableSent + 2 * i;
    ids[at] = kStandardId | (CanopenNodes::kHeartbeatId + table.node[i].id);
    ids[at + 1] = kStandardId | (CanopenNodes::kEmergencyId + table.node[i].id);
  }
  return ids;
}

}  // namespace graben
