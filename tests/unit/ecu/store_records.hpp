// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Records that tell which they are.

#include <cstdint>
#include <cstring>
#include <random>

#include "app/ecu/store/store.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/ecu/memory_disk.hpp"

namespace graben::test::records {

using namespace graben::ecu;
using graben::test::MemoryDisk;

inline constexpr std::uint32_t kHash = 0x12345678;
inline constexpr RecordKey kFirst{RecordKind::kFaults, 0};

/// The `number`th payload of a key: nothing of it stands in another one.
inline MemoryDisk::Bytes payload_of(RecordKey key, unsigned number) {
  std::mt19937 random(number * 64U + key.index);
  MemoryDisk::Bytes bytes(4 + random() % 1200);
  for (std::uint8_t& byte : bytes) {
    byte = static_cast<std::uint8_t>(random());
  }
  std::memcpy(bytes.data(), &number, sizeof number);
  return bytes;
}

/// The number of the payload that was read; 0: none. Fails if it is not whole.
inline unsigned number_of(const Store::Read& read, RecordKey key) {
  if (read.payload == nullptr) {
    return 0;
  }
  unsigned number = 0;
  std::memcpy(&number, read.payload, sizeof number);
  const MemoryDisk::Bytes wanted = payload_of(key, number);
  assert_int_equal(read.length, wanted.size());
  assert_memory_equal(read.payload, wanted.data(), wanted.size());
  return number;
}

inline bool write(Store& store, RecordKey key, unsigned number) {
  const MemoryDisk::Bytes payload = payload_of(key, number);
  return store.write(key, payload.data(), payload.size());
}

inline unsigned read_number(Store& store, RecordKey key) { return number_of(store.read(key), key); }

}  // namespace graben::test::records
