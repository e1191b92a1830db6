// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Frames to signals. What is not certain never reaches the inputs: it is counted, the signals keep
/// their last value and stamp, and it is for the validation to find them too old.

#include <algorithm>
#include <array>
#include <cstdint>
#include <type_traits>

#include "firmware/signals/signal.hpp"
#include "hal/link/challenge.hpp"
#include "hal/link/message_links.hpp"

namespace graben {

/// What the other end says it is; arming needs it to equal our own.
struct PartnerIdentity {
  Signal<std::uint32_t> profile_hash;
  Signal<std::uint32_t> dbc_version;
};

/// Values that the frames of a bus have brought.
template <class Inputs>
struct Received {
  Inputs inputs;
  PartnerIdentity identity;
  Echoes echoes;
};

/// Messages of a receiver; made by hal/link/message_decode.hpp.
template <class To, int count>
struct ReceiveTable {
  using Inputs = To;
  static constexpr int kCount = count;
  /// Stores the data; false, and nothing stored, if a value is out of range.
  using Decode = bool (*)(const dbc::Payload&, TimeUs, Received<Inputs>&);

  std::array<MessageRule, count> rule{};
  std::array<Decode, count> decode{};
  const BusMessage* all = nullptr;  ///< All messages of the bus.
  std::size_t all_count = 0;
  std::uint8_t dbc_version = 0;

  [[nodiscard]] constexpr MessageRules rules() const {
    return {rule.data(), rule.size(), all, all_count};
  }
};

/// What is received, of a table that is a constant of the program.
template <const auto& kTable>
struct ReceptionOf {
  using Inputs = typename std::decay_t<decltype(kTable)>::Inputs;
  static constexpr int kMessageCount = std::decay_t<decltype(kTable)>::kCount;
  [[nodiscard]] static const auto& table() { return kTable; }
};

/// Receives every frame of the bus, keeps those that are meant for the controller. A message is
/// known by its PGN and source address, whatever its priority (identity_of).
///
/// A frame is refused as a whole if its kind, length, CRC, counter or any of its values is wrong. A
/// value that the sender itself calls 'error' or 'not available' is accepted as that: the signal
/// gets kError or kNotAvailable, value 0, and the new stamp.
///
/// `Reception` says what is received: Inputs, kMessageCount, and table() with a ReceiveTable.
template <class Reception>
class MessageReceiver {
 public:
  using Inputs = typename Reception::Inputs;
  using Received = graben::Received<Inputs>;
  static constexpr int kMessageCount = Reception::kMessageCount;
  static_assert(kMessageCount <= static_cast<int>(MessageLinks::kMostMessages));

  explicit MessageReceiver(const BusParts& parts = {})
      : links_(Reception::table().rules(), parts) {}

  /// The 29-bit ids that it keeps, those of all parts too, for a port's filters.
  [[nodiscard]] static std::array<std::uint32_t, kMessageCount> ids() {
    const auto& rules = Reception::table().rule;
    std::array<std::uint32_t, kMessageCount> ids{};
    std::transform(rules.begin(), rules.end(), ids.begin(),
                   [](const MessageRule& rule) { return rule.id; });
    return ids;
  }

  /// `now` becomes the stamp of the signals; the frame's own stamp is not used, so that signals and
  /// control cycle share one clock.
  void accept(const CanFrame& frame, TimeUs now) {
    const int index = links_.admit(frame, now);
    if (index != MessageLinks::kNoMessage) {
      decode(index, frame.data, now);
    }
  }
  /// After the last frame of a cycle: what MessageLinks has held back of it.
  void finish(TimeUs now) {
    dbc::Payload payload{};
    for (int index = links_.take_newest(payload); index != MessageLinks::kNoMessage;
         index = links_.take_newest(payload)) {
      decode(index, payload, now);
    }
  }

  [[nodiscard]] const Inputs& inputs() const { return received_.inputs; }
  [[nodiscard]] const PartnerIdentity& identity() const { return received_.identity; }
  [[nodiscard]] const Echoes& echoes() const { return received_.echoes; }
  /// True if the other end is what we are; as valid and as old as the worse of what it says.
  [[nodiscard]] Signal<bool> same_machine(std::uint32_t own_profile_hash) const {
    const auto& [hash, version] = received_.identity;
    return {hash.value == own_profile_hash && version.value == Reception::table().dbc_version,
            std::min(hash.validity, version.validity), std::min(hash.stamp_us, version.stamp_us)};
  }

  /// Over all messages. An error frame is nobody's, so it is counted here only.
  [[nodiscard]] const LinkCounters& total() const { return links_.total(); }
  /// Frames, 11-bit ones too, whose id is none of ours.
  [[nodiscard]] std::uint32_t foreign() const { return links_.foreign(); }

  /// Counters and end-to-end state of a message; `id` is its 29-bit id. An id that is not received
  /// has empty counters and kNoNewData; kNoNewData is also the state of an unprotected message.
  [[nodiscard]] LinkCounters link(std::uint32_t id) const { return links_.link(id); }
  [[nodiscard]] E2eCheck link_check(std::uint32_t id, TimeUs now) const {
    return links_.link_check(id, now);
  }

  /// As MessageLinks has them.
  [[nodiscard]] FaultSet message_faults(TimeUs now) const { return links_.message_faults(now); }
  /// Of nodes that a table names; a kind's own messages have none.
  [[nodiscard]] static constexpr NodeStart take_start(TimeUs /*now*/) { return {}; }
  [[nodiscard]] static constexpr NodeEmergency emergency() { return {}; }
  /// True if a value was out of range since the last call.
  [[nodiscard]] bool take_out_of_range() { return links_.take_out_of_range(); }

 protected:
  /// For what a kind receives beside its table.
  [[nodiscard]] Inputs& writable() { return received_.inputs; }

 private:
  void decode(int index, const dbc::Payload& payload, TimeUs now) {
    const auto store = Reception::table().decode[static_cast<std::size_t>(index)];
    links_.note_decoded(index, store(payload, now, received_));
  }

  Received received_;
  MessageLinks links_;
};

}  // namespace graben
