// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Incoming commands of a simulated machine, of whatever kind.

#include <array>
#include <cstdint>

#include "app/plant/sender_watch.hpp"
#include "can_dbc/codec.hpp"
#include "firmware/core/time.hpp"
#include "hal/can_port.hpp"
#include "hal/link/e2e.hpp"

namespace graben::plant {

/// What became of the frames of a command, by its id.
struct CommandCounters {
  std::uint64_t accepted = 0;
  std::uint64_t wrong_format = 0;  ///< 11 bit, remote, error, FD or wrong length.
  std::uint64_t rejected = 0;      ///< By CRC or counter, or while synchronising.
  std::uint64_t timeouts = 0;      ///< Times that it had to do without the command.
  std::uint64_t conflicts = 0;     ///< Times that it did without, as there were two senders.
};

inline constexpr TimeUs kCommandTimeoutUs = 100 * kMillisecondUs;

/// The way in of one command. Two senders of it are as good as none.
class CommandLink {
 public:
  template <class Message>
  [[nodiscard]] bool accepts(const CanFrame& frame, TimeUs now) {
    return accepts({Message::kDataId, Message::kMaxDeltaCounter, kCommandTimeoutUs,
                    Message::kCycleTimeMs * kMillisecondUs},
                   frame, now);
  }
  /// Whether the command has been missing for `kCommandTimeoutUs`, or has two senders, from just
  /// now on.
  [[nodiscard]] bool dies(TimeUs now);
  /// The frame that was refused last is a sender's all the same: only its counter does not fit.
  [[nodiscard]] bool refused_authentic() const { return refused_authentic_; }
  [[nodiscard]] bool has_two_senders(TimeUs now) const { return senders_.are_two(now); }
  /// The caller knows a frame for another sender's.
  void note_other_sender(TimeUs now) { senders_.note_other(now); }

  [[nodiscard]] const CommandCounters& counters() const { return counters_; }

 private:
  [[nodiscard]] bool accepts(const E2eConfig& config, const CanFrame& frame, TimeUs now);

  E2eState e2e_;
  SenderWatch senders_;
  bool refused_authentic_ = false;
  bool alive_ = false;
  TimeUs last_us_ = 0;
  CommandCounters counters_;
};

inline bool CommandLink::accepts(const E2eConfig& config, const CanFrame& frame, TimeUs now) {
  constexpr std::uint8_t kLength = 8;
  refused_authentic_ = false;
  if (!frame.extended || frame.remote || frame.error || frame.fd || frame.length != kLength) {
    ++counters_.wrong_format;
    return false;
  }
  const E2eCheck check = e2e_check(config, e2e_, frame.data, now);
  if (check != E2eCheck::kWrongCrc && check != E2eCheck::kRepeated) {
    senders_.note(e2e_accepted(check) || check == E2eCheck::kSynchronising, now);
  }
  if (!e2e_accepted(check)) {
    ++counters_.rejected;
    refused_authentic_ = check != E2eCheck::kWrongCrc && check != E2eCheck::kRepeated;
    return false;
  }
  ++counters_.accepted;
  alive_ = true;
  last_us_ = now;
  return true;
}

inline bool CommandLink::dies(TimeUs now) {
  const bool is_missing = now - last_us_ >= kCommandTimeoutUs;
  if (!alive_ || !(is_missing || senders_.are_two(now))) {
    return false;
  }
  ++(is_missing ? counters_.timeouts : counters_.conflicts);
  alive_ = false;
  return true;
}

/// After a silence a command has to ask for nothing once before it counts again: what comes first
/// may be frames that were stuck in a controller's queue, each of them right and in order.
class NeutralFirst {
 public:
  void command_lost() { needs_neutral_ = true; }
  void saw_neutral() { needs_neutral_ = false; }
  [[nodiscard]] bool holds() const { return needs_neutral_; }

 private:
  bool needs_neutral_ = false;
};

/// Whether a SpoolCommand's enable lets its duties through; an Off ends a silence.
template <class Command>
[[nodiscard]] bool lets_through(const Command& command, NeutralFirst& silence) {
  const bool known = command.enable.state == dbc::RawState::kValid;
  const bool is_on = command.enable.value == Command::Enable::kOn;
  if (known && !is_on) {
    silence.saw_neutral();
  }
  return known && is_on && !silence.holds();
}

/// Gives each frame that is pending to `take`. A cycle takes no more than 4096, so that a flood on
/// the bus cannot stop the simulation.
template <class Take>
void receive_frames(CanPort& port, const Take& take) {
  constexpr int kFramesPerRead = 64;
  constexpr int kReadsPerCycle = 64;
  std::array<CanFrame, kFramesPerRead> frames;
  for (int read = 0; read < kReadsPerCycle; ++read) {
    const int count = port.receive(frames.data(), kFramesPerRead);
    for (int i = 0; i < count; ++i) {
      take(frames[static_cast<std::size_t>(i)]);
    }
    if (count < kFramesPerRead) {
      return;
    }
  }
}

}  // namespace graben::plant
