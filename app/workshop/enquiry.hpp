// SPDX-License-Identifier: Apache-2.0
#pragma once
/// One request of a workshop's tool to an ECU (PGN 59904 of SAE J1939-21), and what comes of it.

#include <cstdint>
#include <optional>
#include <vector>

#include "app/workshop/connection_receiver.hpp"
#include "hal/can_frame.hpp"
#include "hal/j1939/transport.hpp"

namespace graben::workshop {

/// Off-board diagnostic tool 1 of J1939's table of addresses.
inline constexpr std::uint8_t kToolAddress = 0xF9;

enum class Answer : std::uint8_t {
  kNone,     ///< Not yet.
  kMessage,  ///< message() is what was asked for.
  kDone,     ///< What was asked for has been done.
  kRefused,  ///< Not known there, or not allowed.
  kNotNow,   ///< Access denied, or it cannot respond now.
  kSilent,   ///< Nothing has come, three requests long.
};

/// Asked up to three times, 1.5 s apart: an ECU may be busy with another tool for 1.25 s. DM1 comes
/// by itself each second (J1939-73): it is listened for before it is asked for.
class Enquiry {
 public:
  Enquiry(std::uint32_t pgn, std::uint8_t ecu, std::uint8_t tool = kToolAddress);

  void hear(const CanFrame& frame, TimeUs now);
  /// To be called every 10 ms; what is to be sent.
  [[nodiscard]] std::optional<CanFrame> due(TimeUs now);
  [[nodiscard]] Answer answer() const { return answer_; }
  [[nodiscard]] const j1939::LongMessage& message() const { return message_; }

 private:
  void hear_acknowledgment(const CanFrame& frame);

  std::uint32_t pgn_;
  std::uint8_t ecu_;
  std::uint8_t tool_;
  j1939::BamReceiver broadcast_;
  ConnectionReceiver alone_;
  j1939::LongMessage message_;
  Answer answer_ = Answer::kNone;
  int asked_ = 0;
  bool listens_ = false;  ///< It has begun to.
  TimeUs since_us_ = 0;   ///< Asked, or listened.
};

/// A code as J1939-73 has it.
struct TroubleCode {
  std::uint32_t spn = 0;
  std::uint8_t failure_mode = 0;
  std::uint8_t occurrences = 0;  ///< 127: not available.
};

/// Lamps that are lit, and the codes, of a DM1 or DM2.
struct TroubleCodes {
  bool red_stop = false;
  bool amber_warning = false;
  std::vector<TroubleCode> code;
};

[[nodiscard]] TroubleCodes codes_in(const j1939::LongMessage& message);

}  // namespace graben::workshop
