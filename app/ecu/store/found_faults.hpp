// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a controller finds in its store, and how that is said.

#include <array>
#include <string>

#include "app/ecu/store/fault_history.hpp"
#include "app/ecu/store/freeze_frame.hpp"
#include "app/ecu/store/store.hpp"

namespace graben::ecu {

inline constexpr RecordKey kHistoryKey{RecordKind::kFaults, 0};
[[nodiscard]] constexpr RecordKey frame_key(Fault fault) {
  return {RecordKind::kFreezeFrame, static_cast<std::uint16_t>(fault)};
}

/// For a line: no call of these but damaged_words() allocates.
using FoundLine = std::array<char, 200>;

struct FoundFaults {
  ReadState state =
      ReadState::kNothing;  ///< Of the history. Whole bytes that say nothing: damaged.
  bool is_whole = false;    ///< `history` was read, of whatever profile.
  FaultHistory history;
  std::uint32_t checksum = 0;                         ///< Of its bytes.
  int foreign_frames = 0;                             ///< Freeze frames of another profile.
  FaultSet framed;                                    ///< Faults with one of ours,
  std::array<std::uint32_t, kFaultCount> framed_s{};  ///< of that second of operation.
  /// Files of each key, the history's first, then by fault.
  std::array<Store::Read, kFaultCount> read{};

  /// Of this machine: to go on from.
  [[nodiscard]] bool is_own() const { return is_whole && state == ReadState::kRead; }
  /// Freeze frames of what `now` has.
  [[nodiscard]] int frames(const FaultHistory& now) const;
  /// Files.
  [[nodiscard]] int damaged() const;
  [[nodiscard]] std::string damaged_words() const;
};

/// Reads all of it into `found`; `frame` is overwritten.
void find_faults(Store& store, FoundFaults& found, StoredFrame& frame);

/// "read; power cycle 3, 12 h of operation, faults stored: 2, freeze frames: 1"; of `now`, which
/// began with `found`.
[[nodiscard]] FoundLine found_words(const FoundFaults& found, const FaultHistory& now);

}  // namespace graben::ecu
