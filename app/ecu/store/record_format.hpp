// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A record as it lies in a file: 32 bytes of head, then its payload. All numbers little endian.
///
/// | byte | what |
/// |---|---|
/// | 0  | "GRBR" |
/// | 4  | version of this format, 16 bits |
/// | 6  | kind, 16 bits |
/// | 8  | index among the records of its kind, 16 bits; 2 bytes of 0 |
/// | 12 | hash of the machine's profile, 32 bits |
/// | 16 | sequence number, 64 bits: the larger one is the newer copy |
/// | 24 | length of the payload, 32 bits |
/// | 28 | CRC-32 (IEEE 802.3) of the head before it and of the payload |

#include <array>
#include <cstddef>
#include <cstdint>

namespace graben::ecu {

/// What a record holds; the numbers are in the files.
enum class RecordKind : std::uint16_t {
  kFaults = 1,       ///< The history of all faults (fault_history.hpp).
  kFreezeFrame = 2,  ///< One fault's freeze frame, by the fault's number (freeze_frame.hpp).
  kGround = 3,  ///< A tile of ground as built, by its number (app/ecu/ground/ground_record.hpp).
};

struct RecordKey {
  RecordKind kind = RecordKind::kFaults;
  std::uint16_t index = 0;
  [[nodiscard]] bool operator==(const RecordKey& other) const {
    return kind == other.kind && index == other.index;
  }
};

inline constexpr std::uint16_t kRecordVersion = 1;
inline constexpr std::size_t kHeadBytes = 32;
/// Most bytes of a record, head and all: one block of the usual file systems, so that a write wears
/// one of them.
inline constexpr std::size_t kMostRecordBytes = 4096;
inline constexpr std::size_t kMostPayloadBytes = kMostRecordBytes - kHeadBytes;
using RecordBytes = std::array<std::uint8_t, kMostRecordBytes>;

struct RecordHead {
  RecordKey key;
  std::uint32_t profile_hash = 0;
  std::uint64_t sequence = 0;
  std::uint32_t length = 0;  ///< Of the payload, bytes.
};

/// What is made of a copy that is read.
enum class CopyState : std::uint8_t {
  kAbsent = 0,        ///< There is no file, or an empty one.
  kValid = 1,         ///< The head is filled in.
  kDamaged = 2,       ///< It is no record, not whole, or its checksum is wrong.
  kOtherVersion = 3,  ///< Of a format that this program does not know.
  kUnreadable = 4,    ///< Something is there; the files' error() says why it is not read.
};

/// CRC-32 of IEEE 802.3, as zlib's; `before` is that of the bytes before.
[[nodiscard]] std::uint32_t crc32(const std::uint8_t* bytes, std::size_t count,
                                  std::uint32_t before = 0);

/// Writes the head, with its checksum, before a payload of `head.length` bytes that stands at
/// `kHeadBytes` already. Returns the bytes of the record.
std::size_t seal_record(const RecordHead& head, RecordBytes& record);

/// Judges `count` bytes of a file that is to be the record `key`.
[[nodiscard]] CopyState open_record(const RecordBytes& record, std::size_t count, RecordKey key,
                                    RecordHead& head);

}  // namespace graben::ecu
