// SPDX-License-Identifier: Apache-2.0
#include "app/workshop/enquiry.hpp"

#include <algorithm>

#include "hal/j1939/ids.hpp"

namespace graben::workshop {
namespace {

constexpr int kMostRequests = 3;
constexpr TimeUs kAgainUs = 1500 * kMillisecondUs;

std::uint32_t pgn_in(const CanFrame& frame, std::size_t at) {
  return frame.data[at] | static_cast<std::uint32_t>(frame.data[at + 1]) << 8U |
         static_cast<std::uint32_t>(frame.data[at + 2]) << 16U;
}

Answer answer_of(std::uint8_t control) {
  constexpr std::uint8_t kDone = 0;
  constexpr std::uint8_t kUnknown = 1;
  return control == kDone      ? Answer::kDone
         : control == kUnknown ? Answer::kRefused
                               : Answer::kNotNow;
}

}  // namespace

Enquiry::Enquiry(std::uint32_t pgn, std::uint8_t ecu, std::uint8_t tool)
    : pgn_(pgn), ecu_(ecu), tool_(tool), broadcast_(pgn, ecu), alone_(pgn, ecu, tool) {}

void Enquiry::hear_acknowledgment(const CanFrame& frame) {
  const bool for_us = frame.data[4] == tool_ || frame.data[4] == j1939::kGlobalAddress;
  if (for_us && pgn_in(frame, 5) == pgn_) {
    answer_ = answer_of(frame.data[0]);
  }
}

void Enquiry::hear(const CanFrame& frame, TimeUs now) {
  const j1939::Address from = j1939::address_of(frame.id);
  const bool is_a_packet = frame.extended && !frame.remote && !frame.error && !frame.fd &&
                           from.sender == ecu_ && frame.length == frame.data.size();
  if (!is_a_packet) {
    return;
  }
  // What comes before the first request is no answer to it.
  if (answer_ != Answer::kNone || !listens_) {
    return;
  }
  if (broadcast_.hear(frame, now)) {
    message_ = broadcast_.message();
    answer_ = Answer::kMessage;
  } else if (alone_.hear(frame, now)) {
    message_ = alone_.message();
    answer_ = Answer::kMessage;
  } else if (from.pgn == pgn_) {
    message_.pgn = pgn_;
    message_.size = frame.length;
    std::copy(frame.data.begin(), frame.data.end(), message_.bytes.begin());
    answer_ = Answer::kMessage;
  } else if (from.pgn == j1939::kAcknowledgmentPgn) {
    hear_acknowledgment(frame);
  }
}

std::optional<CanFrame> Enquiry::due(TimeUs now) {
  if (const std::optional<CanFrame> said = alone_.due(now)) {
    return said;
  }
  if (answer_ != Answer::kNone || (listens_ && now - since_us_ < kAgainUs)) {
    return std::nullopt;
  }
  if (asked_ == kMostRequests) {
    answer_ = Answer::kSilent;
    return std::nullopt;
  }
  since_us_ = now;
  if (!listens_ && pgn_ == j1939::kActiveCodesPgn) {
    listens_ = true;
    return std::nullopt;
  }
  listens_ = true;
  ++asked_;
  CanFrame frame;
  frame.id = j1939::id_of(j1939::kDiagnosticPriority, j1939::kRequestPgn, ecu_, tool_);
  frame.length = 3;
  frame.stamp_us = now;
  frame.data = {static_cast<std::uint8_t>(pgn_), static_cast<std::uint8_t>(pgn_ >> 8U),
                static_cast<std::uint8_t>(pgn_ >> 16U)};
  return frame;
}

TroubleCodes codes_in(const j1939::LongMessage& message) {
  constexpr std::size_t kLampBytes = 2;
  constexpr std::size_t kCodeBytes = 4;
  TroubleCodes codes;
  codes.red_stop = (message.bytes[0] >> 4U & 3U) == 1U;
  codes.amber_warning = (message.bytes[0] >> 2U & 3U) == 1U;
  for (std::size_t at = kLampBytes; at + kCodeBytes <= message.size; at += kCodeBytes) {
    const std::uint8_t* const four = &message.bytes[at];
    const TroubleCode code{four[0] | static_cast<std::uint32_t>(four[1]) << 8U |
                               static_cast<std::uint32_t>(four[2] >> 5U) << 16U,
                           static_cast<std::uint8_t>(four[2] & 31U),
                           static_cast<std::uint8_t>(four[3] & 127U)};
    // One without a number says that there is none.
    if (code.spn != 0 || code.failure_mode != 0) {
      codes.code.push_back(code);
    }
  }
  return codes;
}

}  // namespace graben::workshop
