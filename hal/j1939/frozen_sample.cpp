// SPDX-License-Identifier: Apache-2.0
#include "hal/j1939/frozen_sample.hpp"

#include "hal/j1939/ids.hpp"

namespace graben::j1939 {
namespace {

/// In the freeze frame (bit 1 is 0); in no stream of data and no test; reserved bits are 1.
constexpr std::uint8_t kInFreezeFrame = 0x1E;
/// The largest raw value of 16 bit that J1939-71 has for a measured one.
constexpr double kMostRaw = 64255.0;

void put_byte(LongMessage& message, std::uint32_t value) {
  message.bytes[message.size++] = static_cast<std::uint8_t>(value & 0xFFU);
}

}  // namespace

std::uint16_t sample_word(double value, double resolution, double offset) {
  const double raw = (value - offset) / resolution + 0.5;
  return raw >= 0.0 && raw < kMostRaw + 1.0 ? static_cast<std::uint16_t>(raw) : kNoWord;
}

LongMessage supported_parameters() {
  static_assert(4 * (kSampleWords + 1) <= kMostBytes);
  LongMessage message;
  message.pgn = kSupportPgn;
  for (std::uint32_t i = 0; i <= kSampleWords; ++i) {
    const std::uint32_t spn = kFirstParameterSpn + i;
    put_byte(message, spn);
    put_byte(message, spn >> 8U);
    put_byte(message, (spn >> 16U & 0x07U) << 5U | kInFreezeFrame);
    put_byte(message, i < kSampleWords ? 2 : 1);
  }
  return message;
}

LongMessage freeze_frame(const FrozenSample& sample, const Occurrences& stored) {
  constexpr std::size_t kCodeBytes = 4;
  constexpr std::size_t kFrameBytes = kCodeBytes + 2 * kSampleWords + 1;
  static_assert(1 + kFrameBytes <= kMostBytes);
  LongMessage message;
  message.pgn = kFreezeFramePgn;
  const std::uint8_t occurrences = stored[static_cast<std::size_t>(sample.fault)];
  if (sample.fault == Fault::kNone || occurrences == 0) {
    message.bytes = {0, 0, 0, 0, 0, 0xFF, 0xFF, 0xFF};
    message.size = 8;
    return message;
  }
  put_byte(message, kFrameBytes);
  for (const std::uint8_t byte : code_bytes(sample.fault, occurrences)) {
    put_byte(message, byte);
  }
  for (const std::uint16_t word : sample.word) {
    put_byte(message, word);
    put_byte(message, word >> 8U);
  }
  put_byte(message, sample.mode);
  return message;
}

}  // namespace graben::j1939
