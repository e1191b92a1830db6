// SPDX-License-Identifier: Apache-2.0
#pragma once
/// When which trouble code goes into DM1 (J1939-73, PGN 65226), one code a frame.
///
/// Active faults take turns in the order of their numbers, with a period of 1 s over their number,
/// in whole tens of milliseconds and 100 ms at least: up to ten are each on the bus within 1 s.
/// So is one whose turn would come later because others have gone; the longest unsaid comes first.
/// With none a frame says so once a second. A fault that appears is said in the same cycle, and of
/// several one in each cycle; one that was on the bus less than 1 s ago waits for its turn, so that
/// a fault that comes and goes does not flood the bus.

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/core/fault_set.hpp"
#include "firmware/core/time.hpp"

namespace graben {

/// SPN of fault 0; the range from here to 524287 is the maker's to assign.
inline constexpr std::uint32_t kDm1FirstSpn = 520192;
inline constexpr std::uint8_t kDm1MaxOccurrences = 126;  ///< 127 is 'not available'.

/// What a DM1 frame carries. Without a fault all is 0.
struct Dm1Content {
  bool amber_warning = false;  ///< A fault is active that does not stop.
  bool red_stop = false;       ///< A fault is active that stops.
  std::uint32_t spn = 0;
  std::uint8_t fmi = 0;
  std::uint8_t occurrences = 0;  ///< How often the fault has appeared; stays at its maximum.
};

class Dm1 {
 public:
  /// To be called every 10 ms. True if a frame is due, which `content` then is.
  [[nodiscard]] bool due(const FaultSet& active, TimeUs now, Dm1Content& content);

 private:
  struct Entry {
    std::uint8_t occurrences = 0;
    bool is_new = false;  ///< Active, and not said yet.
    bool was_said = false;
    TimeUs said_us = 0;
  };

  void note(const FaultSet& active, TimeUs now);
  [[nodiscard]] Fault first_new() const;
  [[nodiscard]] Fault overdue(TimeUs now) const;
  [[nodiscard]] Fault next_in_turn(TimeUs now) const;
  [[nodiscard]] bool is_turn(TimeUs now) const;
  [[nodiscard]] Entry& entry(Fault fault) { return entries_[static_cast<std::size_t>(fault)]; }

  FaultSet active_;  ///< In the last call.
  std::array<Entry, kFaultCount> entries_{};
  Fault last_ = Fault::kNone;  ///< Whose turn it was last.
  bool has_started_ = false;
  TimeUs turn_us_ = 0;  ///< When the last turn was.
};

}  // namespace graben
