// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Outputs to frames: the schedule, what is due in this cycle, protected and saturated.

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "can_dbc/codec.hpp"
#include "firmware/core/time.hpp"
#include "hal/can_frame.hpp"
#include "hal/link/dm1.hpp"
#include "hal/link/message_rules.hpp"

namespace graben {

/// What is remembered of a message that is sent.
struct SendState {
  TimeUs due_us = 0;
  std::uint8_t counter = 0;  ///< Of the next frame.
};

/// True if a message is due; sets when it is next. A call that comes up to half a control cycle
/// early or late keeps the schedule; one that comes later starts it again from there.
[[nodiscard]] bool take_due(TimeUs& due_us, TimeUs period_us, TimeUs now);

/// The frame of an 8-byte message without protection.
[[nodiscard]] CanFrame frame_of(std::uint32_t id, const dbc::Payload& payload, TimeUs now);

/// The frame of a message, protected if it is to be.
[[nodiscard]] CanFrame next_frame(const SendRule& rule, SendState& state,
                                  const dbc::Payload& payload, TimeUs now);

/// Health of the process that the controller runs in. Counts saturate at 250 on the bus.
struct ProcessHealth {
  std::uint32_t allocations = 0;  ///< Of the process since its first cycle.
  std::uint32_t page_faults = 0;  ///< Of the control thread since its first cycle.
  std::uint32_t overruns = 0;     ///< Late cycles since the start.
  bool real_time = false;         ///< With real-time priority and locked memory.
};

/// What the process says of itself, beside the controller's outputs.
struct EcuDiagnosis {
  TimeUs cycle_time_us = 0;           ///< Of the last cycle; saturates at 64255.
  std::uint32_t rejected_frames = 0;  ///< Since the start; saturates at 250.
  std::uint32_t profile_hash = 0;
  std::uint32_t dropped_frames = 0;  ///< That the bus did not take, since the start.
  std::uint16_t stamp = 0;           ///< Of the next EcuIdentity (hal/link/challenge.hpp).
  ProcessHealth process;
};

/// Messages of a transmitter; made by hal/link/message_encode.hpp.
template <class From, int count>
struct SendTable {
  using Outputs = From;
  static constexpr int kCount = count;
  using Encode = dbc::Payload (*)(const Outputs&, const EcuDiagnosis&);

  std::array<SendRule, count> rule{};
  std::array<Encode, count> encode{};
  std::uint32_t dm1_id = 0;
  dbc::Payload (*dm1)(const Dm1Content&) = nullptr;
};

/// What is sent, of a table that is a constant of the program.
template <const auto& kTable>
struct TransmissionOf {
  using Outputs = typename std::decay_t<decltype(kTable)>::Outputs;
  static constexpr int kPeriodicCount = std::decay_t<decltype(kTable)>::kCount;
  [[nodiscard]] static const auto& table() { return kTable; }
};

/// Sends each message at its cycle time, counted from the first call and spread so that no call
/// sends all; DM1 see hal/link/dm1.hpp. A call that comes up to half a control cycle early or
/// late keeps the schedule; one that comes later starts it again from there: nothing is sent twice
/// to catch up.
///
/// Values beyond a signal's range are saturated; one that is not finite is sent as 'error', unless
/// it is a command's.
///
/// Messages of parts that the machine does not have are not sent.
///
/// `Transmission` says what is sent: Outputs, kPeriodicCount, and table() with a SendTable, most
/// urgent first.
template <class Transmission>
class MessageTransmitter {
 public:
  using Outputs = typename Transmission::Outputs;
  static constexpr int kPeriodicCount = Transmission::kPeriodicCount;
  static constexpr int kMessageCount = kPeriodicCount + 1;  ///< DM1 has its own times.
  using Frames = std::array<CanFrame, kMessageCount>;

  explicit MessageTransmitter(const BusParts& parts = {}) : parts_(parts) {}

  /// Whether an id is that of a command beside the kind's own.
  [[nodiscard]] static constexpr bool is_table_command(std::uint32_t /*id*/) { return false; }

  /// Sends a node of CANopen its start in the next frames, where a table has nodes.
  static constexpr void start_node(const NodeStart& /*start*/) {}

  /// The 29-bit ids of all that is sent, those of all parts too.
  [[nodiscard]] static std::array<std::uint32_t, kMessageCount> ids() {
    const auto& table = Transmission::table();
    std::array<std::uint32_t, kMessageCount> ids{};
    for (std::size_t i = 0; i < table.rule.size(); ++i) {
      ids[i] = table.rule[i].id;
    }
    ids[kPeriodicCount] = table.dm1_id;
    return ids;
  }

  /// Writes the frames due at `now` into `out`, most urgent first; returns how many. To be called
  /// every 10 ms.
  template <std::size_t room>
  [[nodiscard]] int frames(const Outputs& outputs, const EcuDiagnosis& diagnosis, TimeUs now,
                           std::array<CanFrame, room>& out);

  /// Writes what would be the next frame of each message whose id `wanted` takes, due or not;
  /// returns how many. Nothing is remembered of them: they are for another hand to send.
  template <class Wanted, std::size_t room>
  [[nodiscard]] int next_frames(const Outputs& outputs, const Wanted& wanted, TimeUs now,
                                std::array<CanFrame, room>& out) const;

 private:
  void start(TimeUs now);

  BusParts parts_;
  bool started_ = false;
  std::array<SendState, kPeriodicCount> state_{};
  Dm1 dm1_;
};

template <class Transmission>
void MessageTransmitter<Transmission>::start(TimeUs now) {
  started_ = true;
  for (std::size_t i = 0; i < state_.size(); ++i) {
    state_[i].due_us = now + Transmission::table().rule[i].phase_us;
  }
}

template <class Transmission>
template <std::size_t room>
int MessageTransmitter<Transmission>::frames(const Outputs& outputs, const EcuDiagnosis& diagnosis,
                                             TimeUs now, std::array<CanFrame, room>& out) {
  static_assert(room >= kMessageCount);
  const auto& table = Transmission::table();
  if (!started_) {
    start(now);
  }
  std::size_t written = 0;
  for (std::size_t i = 0; i < state_.size(); ++i) {
    const bool is_due = take_due(state_[i].due_us, table.rule[i].period_us, now);
    if (is_due && has_part(parts_, table.rule[i].part)) {
      out[written++] =
          next_frame(table.rule[i], state_[i], table.encode[i](outputs, diagnosis), now);
    }
  }
  Dm1Content content;
  if (dm1_.due(outputs.status.faults, now, content)) {
    out[written++] = frame_of(table.dm1_id, table.dm1(content), now);
  }
  return static_cast<int>(written);
}

template <class Transmission>
template <class Wanted, std::size_t room>
int MessageTransmitter<Transmission>::next_frames(const Outputs& outputs, const Wanted& wanted,
                                                  TimeUs now,
                                                  std::array<CanFrame, room>& out) const {
  static_assert(room >= kMessageCount);
  const auto& table = Transmission::table();
  std::size_t written = 0;
  for (std::size_t i = 0; i < state_.size(); ++i) {
    if (wanted(table.rule[i].id) && has_part(parts_, table.rule[i].part)) {
      SendState state = state_[i];
      out[written++] = next_frame(table.rule[i], state, table.encode[i](outputs, {}), now);
    }
  }
  return static_cast<int>(written);
}

}  // namespace graben
