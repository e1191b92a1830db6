// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Admission of frames: kind, length, end-to-end protection, and counters of what became of each.

#include <array>
#include <cstddef>
#include <cstdint>

#include "can_dbc/codec.hpp"
#include "firmware/core/fault_set.hpp"
#include "firmware/core/time.hpp"
#include "hal/can_frame.hpp"
#include "hal/link/e2e_window.hpp"
#include "hal/link/message_clock.hpp"
#include "hal/link/message_rules.hpp"

namespace graben {

/// Frames by what became of them. The counters stay at their maximum.
struct LinkCounters {
  std::uint32_t accepted = 0;
  std::uint32_t synchronising = 0;  ///< Good, but the sender's sequence is not confirmed yet.
  std::uint32_t wrong_kind = 0;     ///< Remote, error, FD, or an 11-bit frame with one of our ids.
  std::uint32_t wrong_length = 0;
  std::uint32_t wrong_crc = 0;
  std::uint32_t masquerade = 0;     ///< A wrong CRC that fits another message; not in wrong_crc.
  std::uint32_t wrong_counter = 0;  ///< Repeated, invalid, late, early, stale, or too many lost.
  std::uint32_t out_of_range = 0;   ///< A value outside its [min|max] behind a right CRC.
  std::uint32_t surplus = 0;        ///< More at once than are looked at (MessageLinks).
  std::uint32_t own_id = 0;         ///< Under an id that we send; in the total only.
};

/// All that were refused. Frames of a start-up handshake are not: every start has some.
constexpr std::uint32_t rejected(const LinkCounters& counters) {
  const std::uint64_t sum = std::uint64_t{counters.wrong_kind} + counters.wrong_length +
                            counters.wrong_crc + counters.masquerade + counters.wrong_counter +
                            counters.out_of_range + counters.surplus + counters.own_id;
  return sum > UINT32_MAX ? UINT32_MAX : static_cast<std::uint32_t>(sum);
}

/// The links of all messages that a receiver takes: those of parts that the machine does not
/// have are foreign to it. A message's index is that of its rule.
///
/// What comes at one time is bounded, or a babbling sender could make a cycle as long as it likes.
/// No sender of ours is faster than a cycle of 10 ms, and what waits longer than 50 ms is thrown
/// away: more than kMostAtOnce frames of a message with one `now` are not its sender's. Of a
/// protected message the surplus is refused unseen, and its first three frames count as wrong in
/// sequence, which is a fault. Of an unprotected one, where nothing tells right from wrong, the
/// newest of them counts, as it does among fewer (take_newest).
///
/// A frame whose message's clock has fallen behind (hal/link/message_clock.hpp) is not used. A
/// frame under any id with our own address is somebody else's, for no port hears what it sends.
class MessageLinks {
 public:
  /// An excavator's bus has 18; what is planned is in can_dbc/README.md.
  static constexpr std::size_t kMostMessages = 24;
  static constexpr int kNoMessage = -1;
  /// So long after a frame under an id of ours its sender counts as there: a second is the longest
  /// that a controller is silent.
  static constexpr TimeUs kOwnHeard_us = 1200 * kMillisecondUs;
  static constexpr int kMostAtOnce = 7;

  /// At most kMostMessages rules.
  MessageLinks(const MessageRules& rules, const BusParts& parts);

  /// Index of the message whose data may be decoded, or kNoMessage; the reason is counted.
  [[nodiscard]] int admit(const CanFrame& frame, TimeUs now);
  /// The same of a frame whose message is known, where two buses have messages of one id.
  [[nodiscard]] int admit_as(int index, const CanFrame& frame, TimeUs now);
  /// After all frames of a cycle: index of a message of whose surplus the newest, `payload`, is
  /// still to be decoded, or kNoMessage. To be called until then.
  [[nodiscard]] int take_newest(dbc::Payload& payload);
  /// Whether all values of an admitted frame were in their ranges.
  void note_decoded(int index, bool in_range);

  [[nodiscard]] const LinkCounters& total() const { return total_; }
  [[nodiscard]] std::uint32_t foreign() const { return foreign_; }
  [[nodiscard]] LinkCounters link(std::uint32_t id) const;
  [[nodiscard]] E2eCheck link_check(std::uint32_t id, TimeUs now) const;
  /// kMessageCorrupt, kMessageSequence, kMessageMasquerade; kStreamLate, kSecondController.
  [[nodiscard]] FaultSet message_faults(TimeUs now) const;
  [[nodiscard]] bool take_out_of_range();

 private:
  /// A place of the hash table of identities (identity_of); linear probing.
  struct Known {
    std::uint32_t identity = 0;
    int index = kNoMessage;
  };
  static constexpr std::size_t kPlaces = 64;
  static_assert(kPlaces >= 2 * kMostMessages);
  static constexpr int kOwnMessage = -2;  ///< Instead of an index.
  /// Frames of one message with one stamp.
  struct Batch {
    TimeUs now = 0;
    int frames = 0;
  };

  [[nodiscard]] std::size_t place_of(std::uint32_t identity) const;
  [[nodiscard]] int index_of(std::uint32_t id) const {
    return known_[place_of(identity_of(id))].index;
  }
  [[nodiscard]] bool is_any_message(const CanFrame& frame) const;
  [[nodiscard]] int place_in_batch(std::size_t index, TimeUs now);
  void refuse_surplus(std::size_t index, int place, const CanFrame& frame, TimeUs now);
  [[nodiscard]] bool is_fresh(std::size_t index, const E2eState& before, TimeUs now);
  [[nodiscard]] bool passes_e2e(std::size_t index, const CanFrame& frame, TimeUs now);
  void count(std::size_t index, std::uint32_t LinkCounters::*counter);

  MessageRules rules_;
  std::array<Known, kPlaces> known_{};
  std::array<bool, 256> fits_a_message_{};  ///< By e2e_fitting_signature, of all of the bus.
  std::array<Batch, kMostMessages> batch_{};
  std::array<dbc::Payload, kMostMessages> newest_{};  ///< Of an unprotected message's surplus.
  std::uint32_t has_newest_ = 0;                      ///< A bit for each message.
  static_assert(kMostMessages <= 32);
  std::array<E2eState, kMostMessages> e2e_{};
  std::array<E2eWindow, kMostMessages> window_{};
  std::array<MessageClock, kMostMessages> clock_{};
  std::array<LinkCounters, kMostMessages> link_{};
  LinkCounters total_;
  std::uint32_t foreign_ = 0;
  bool out_of_range_ = false;
  bool own_heard_ = false;
  TimeUs own_us_ = 0;  ///< When last.
};

}  // namespace graben
