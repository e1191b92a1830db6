#pragma once
/// Which frames of a bus may be used: kind, length, end-to-end protection, and what became of each.

#include <array>
#include <cstddef>
#include <cstdint>

#include "can_dbc/codec.hpp"
#include "firmware/core/fault_set.hpp"
#include "firmware/core/time.hpp"
#include "hal/bus_parts.hpp"
#include "hal/can_frame.hpp"
#include "hal/e2e.hpp"
#include "hal/e2e_window.hpp"
#include "hal/link_counters.hpp"

namespace graben {

/// How a message that is received is known and protected.
struct MessageRule {
  std::uint32_t id = 0;  ///< 29 bits: priority, page, PGN and source address.
  std::uint8_t length = 0;
  bool is_protected = false;
  E2eConfig e2e;
  BusPart part = nullptr;  ///< Taken only by a machine that has it.
};

/// One cycle more than the counter may skip: then the counter alone would refuse the frame, and it
/// is far below the 15 cycles after which it would not.
template <class Message>
constexpr MessageRule message_rule(BusPart part) {
  constexpr TimeUs kMaxSilenceUs =
      (Message::kMaxDeltaCounter + 1) * Message::kCycleTimeMs * kMillisecondUs;
  return {Message::kId, Message::kLength, Message::kProtected,
          E2eConfig{Message::kDataId, Message::kMaxDeltaCounter, kMaxSilenceUs,
                    Message::kCycleTimeMs * kMillisecondUs},
          part};
}

/// The rules of a receiver, and all messages of its bus; both have to outlive what uses them.
struct MessageRules {
  const MessageRule* rule = nullptr;
  std::size_t count = 0;
  const dbc::MessageInfo* all = nullptr;
  std::size_t all_count = 0;
};

/// The links of all messages that a receiver takes: those of parts that the machine hasn't got are
/// foreign to it. A message's index is that of its rule.
class MessageLinks {
 public:
  static constexpr std::size_t kMostMessages = 16;
  static constexpr int kNoMessage = -1;

  /// At most kMostMessages rules.
  MessageLinks(const MessageRules& rules, const BusParts& parts) : rules_(rules), parts_(parts) {}

  /// Index of the message whose data may be decoded, or kNoMessage; the reason is counted.
  [[nodiscard]] int admit(const CanFrame& frame, TimeUs now);
  /// Whether all values of an admitted frame were in their ranges.
  void note_decoded(int index, bool in_range);

  [[nodiscard]] const LinkCounters& total() const { return total_; }
  [[nodiscard]] std::uint32_t foreign() const { return foreign_; }
  [[nodiscard]] LinkCounters link(std::uint32_t id) const;
  [[nodiscard]] E2eCheck link_check(std::uint32_t id, TimeUs now) const;
  [[nodiscard]] FaultSet message_faults(TimeUs now) const;
  [[nodiscard]] bool take_out_of_range();

 private:
  [[nodiscard]] int index_of(std::uint32_t id) const;
  [[nodiscard]] bool is_any_message(const CanFrame& frame) const;
  [[nodiscard]] bool passes_e2e(std::size_t index, const CanFrame& frame, TimeUs now);
  void count(std::size_t index, std::uint32_t LinkCounters::*counter);

  MessageRules rules_;
  BusParts parts_;
  std::array<E2eState, kMostMessages> e2e_{};
  std::array<E2eWindow, kMostMessages> window_{};
  std::array<LinkCounters, kMostMessages> link_{};
  LinkCounters total_;
  std::uint32_t foreign_ = 0;
  bool out_of_range_ = false;
};

}  // namespace graben
