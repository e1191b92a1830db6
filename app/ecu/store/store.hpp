// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Records that outlive the power, each in two copies that are written alternately.
///
/// The newest copy that is known to be on the disk is never written to: whatever a power cut leaves
/// of the other one, lost, halved or out of order, is either whole (then it is the newer record) or
/// fails its checksum (then the older one counts). No file is ever renamed or made shorter, so
/// after the first two writes of a record no file system has to find room for it: a full disk keeps
/// what it has.
///
/// Of one thread at a time. Nothing here allocates.

#include <array>
#include <cstddef>
#include <cstdint>

#include "app/ecu/store/record_format.hpp"
#include "app/ecu/store/store_files.hpp"

namespace graben::ecu {

/// "faults.a", "frame-012.b", "ground-012.b"
using FileName = std::array<char, 24>;
[[nodiscard]] FileName file_name(RecordKey key, unsigned copy);

/// A record as it was found.
struct FoundRecord {
  std::array<CopyState, 2> copy{};
  std::array<std::uint64_t, 2> sequence{};  ///< Of a valid copy.
  int newest = -1;                          ///< The valid copy that counts; -1: none.
  RecordHead head;                          ///< Its head.
};

/// Reads both copies; `record` is the newest valid one's bytes.
[[nodiscard]] FoundRecord find_record(StoreFiles& files, RecordKey key, RecordBytes& record);

/// What became of a read.
enum class ReadState : std::uint8_t {
  kRead = 0,          ///< The payload is there.
  kNothing = 1,       ///< There is no such record yet.
  kOtherProfile = 2,  ///< Of a machine with another profile: begins anew. The payload is there.
  kOtherVersion = 3,  ///< Of another format: begins anew.
  kDamaged = 4,       ///< No copy is whole: begins anew.
};

class Store {
 public:
  /// `files` outlives the store.
  Store(StoreFiles& files, std::uint32_t profile_hash)
      : files_(files), profile_hash_(profile_hash) {}

  /// Where its files are now. Of another place nothing is known here until it is read; while there
  /// is none, nothing is read or written. To be called before each row of reads and writes: the
  /// first read or write calls it where nobody has.
  [[nodiscard]] Place look();

  /// The newest valid payload, which stays until the next call; `payload` is null unless there is
  /// one.
  struct Read {
    ReadState state = ReadState::kNothing;
    std::array<bool, 2> is_damaged{};  ///< Of the copies; or they cannot be read.
    const std::uint8_t* payload = nullptr;
    std::size_t length = 0;
  };
  [[nodiscard]] Read read(RecordKey key);

  /// `payload` is not that of read(). True once the record is on the disk: from then on, no power
  /// cut loses it or anything newer of its key. False leaves what was there before, and the next
  /// write tries again in the same place.
  [[nodiscard]] bool write(RecordKey key, const std::uint8_t* payload, std::size_t length);

  /// Why the last write failed.
  [[nodiscard]] const char* error() const { return files_.error(); }
  [[nodiscard]] std::uint32_t profile_hash() const { return profile_hash_; }

 private:
  /// Most different records. [-; size: a freeze frame a fault number, and as many others; or all
  /// tiles of ground]
  static constexpr std::size_t kMostSlots = 256;
  struct Slot {
    RecordKey key;
    int newest = -1;
    std::uint64_t sequence = 0;  ///< The largest that either copy has had.
    /// Not only in memory, where a process before us may have left it.
    bool newest_is_on_disk = false;
    std::array<bool, 2> is_listed{};  ///< The copy's file is in the folder on the disk.
  };

  [[nodiscard]] bool is_reached();
  /// Null if there are too many.
  Slot* slot_of(RecordKey key);
  bool make_safe(Slot& slot);

  StoreFiles& files_;
  std::uint32_t profile_hash_;
  std::array<Slot, kMostSlots> slots_{};
  std::size_t slot_count_ = 0;
  bool is_there_ = false;  ///< The place, when it was looked for last.
  RecordBytes record_{};
};

}  // namespace graben::ecu
