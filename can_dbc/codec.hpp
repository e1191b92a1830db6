// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the generated codecs are made of: the bits of a payload to and from physical values.
/// Everything is constexpr, nothing allocates, nothing fails: a value that cannot be said on the
/// bus is said as 'error'. Intel byte order, unsigned raw values, J1939 special values.

#include <array>
#include <cstdint>
#include <limits>

namespace graben::dbc {

/// The data bytes of a frame.
using Payload = std::array<std::uint8_t, 8>;

/// What a raw value says. 'Error' and 'not available' stay distinct, as J1939 has them.
enum class RawState : std::uint8_t {
  kValid = 0,
  kOutOfRange = 1,    ///< Neither within [min|max] nor a special value.
  kError = 2,         ///< The sender says that its source has failed.
  kNotAvailable = 3,  ///< The sender says that it has no such value.
};

/// A physical value in the SI unit that its member's name ends with. `value` is meaningful only
/// while `state` is kValid; it is 0 otherwise.
struct Physical {
  double value = 0.0;
  RawState state = RawState::kNotAvailable;
};

/// A state. E's numbers are the raw values of the DBC's value table.
template <class E>
struct Coded {
  E value{};
  RawState state = RawState::kNotAvailable;
};

/// A plain number without scale: an index, a counter, a hash.
struct Count {
  std::uint32_t value = 0;
  RawState state = RawState::kNotAvailable;
};

/// Where a signal lies and what its raw values mean:
/// SI value = (raw + raw_offset) * numerator / denominator.
/// The quotient keeps decimal scales exact: full scale and neutral decode to the very number.
struct Field {
  const char* name;
  const char* unit;  ///< SI unit of the value, "" for none.
  std::uint8_t start_bit;
  std::uint8_t width;
  std::uint32_t raw_min;  ///< Raw values of [min|max].
  std::uint32_t raw_max;
  std::int64_t error_raw;          ///< -1: the signal cannot say it.
  std::int64_t not_available_raw;  ///< -1: the signal cannot say it.
  std::uint32_t start_raw;         ///< What a message that nobody has filled in carries.
  std::int32_t raw_offset;
  double numerator;
  double denominator;
};

/// A message as tables of messages need it.
struct MessageInfo {
  const char* name;
  const char* sender;
  std::uint32_t id;  ///< 29 bits.
  std::uint8_t length;
  std::uint16_t cycle_time_ms;
  bool is_protected;  ///< CRC in byte 0, counter in the low nibble of byte 1.
  std::uint16_t data_id;
  std::uint8_t max_delta_counter;
};

template <class Message>
constexpr MessageInfo message_info() {
  return {Message::kName,        Message::kSender,    Message::kId,     Message::kLength,
          Message::kCycleTimeMs, Message::kProtected, Message::kDataId, Message::kMaxDeltaCounter};
}

/// The types of all messages of a database, for code that visits each.
template <class... Messages>
struct MessageList {};

/// The bytes as one word and back, Intel order: one load and one store where a loop would be eight.
constexpr std::uint64_t word_of(const Payload& bytes) {
  return std::uint64_t{bytes[0]} | std::uint64_t{bytes[1]} << 8U | std::uint64_t{bytes[2]} << 16U |
         std::uint64_t{bytes[3]} << 24U | std::uint64_t{bytes[4]} << 32U |
         std::uint64_t{bytes[5]} << 40U | std::uint64_t{bytes[6]} << 48U |
         std::uint64_t{bytes[7]} << 56U;
}
constexpr Payload payload_of(std::uint64_t word) {
  const auto byte = [word](unsigned n) { return static_cast<std::uint8_t>(word >> (8U * n)); };
  return {byte(0), byte(1), byte(2), byte(3), byte(4), byte(5), byte(6), byte(7)};
}

/// Raw value of the `width` (1 .. 32) bits from `start_bit`, Intel order.
constexpr std::uint32_t extract(const Payload& payload, unsigned start_bit, unsigned width) {
  return static_cast<std::uint32_t>((word_of(payload) >> start_bit) &
                                    ((std::uint64_t{1} << width) - 1U));
}

/// Puts the low `width` (1 .. 32) bits of `raw` to `start_bit`, Intel order; other bits stay.
constexpr void insert(Payload& payload, unsigned start_bit, unsigned width, std::uint32_t raw) {
  const std::uint64_t mask = ((std::uint64_t{1} << width) - 1U) << start_bit;
  const std::uint64_t bits = (std::uint64_t{raw} << start_bit) & mask;
  payload = payload_of((word_of(payload) & ~mask) | bits);
}

/// J1939 gives a special value of two bytes or more by its top byte alone: 0xFE00 .. 0xFEFF are all
/// 'error'.
constexpr bool says(std::int64_t special_raw, unsigned width, std::uint32_t raw) {
  if (special_raw < 0) {
    return false;
  }
  const unsigned ignored_bits = width < 16U ? 0U : width - 8U;
  return (static_cast<std::uint32_t>(special_raw) >> ignored_bits) == (raw >> ignored_bits);
}

constexpr RawState classify(const Field& field, std::uint32_t raw) {
  if (says(field.error_raw, field.width, raw)) {
    return RawState::kError;
  }
  if (says(field.not_available_raw, field.width, raw)) {
    return RawState::kNotAvailable;
  }
  return raw >= field.raw_min && raw <= field.raw_max ? RawState::kValid : RawState::kOutOfRange;
}

/// What is sent in the place of a value that is none: the error value, or the start value where the
/// signal has no error value.
constexpr std::uint32_t refused_raw(const Field& field) {
  return field.error_raw >= 0 ? static_cast<std::uint32_t>(field.error_raw) : field.start_raw;
}

/// Raw value of a state other than kValid. A value out of range is as unusable as a failed one.
constexpr std::uint32_t special_raw(const Field& field, RawState state) {
  if (state == RawState::kNotAvailable) {
    return field.not_available_raw >= 0 ? static_cast<std::uint32_t>(field.not_available_raw)
                                        : field.start_raw;
  }
  return refused_raw(field);
}

constexpr double physical_of(const Field& field, std::uint32_t raw) {
  const auto counts = static_cast<double>(std::int64_t{raw} + field.raw_offset);
  return counts * field.numerator / field.denominator;
}

constexpr void from_raw(const Field& field, std::uint32_t raw, Physical& signal) {
  signal.state = classify(field, raw);
  signal.value = signal.state == RawState::kValid ? physical_of(field, raw) : 0.0;
}

constexpr void from_raw(const Field& field, std::uint32_t raw, Count& signal) {
  signal.state = classify(field, raw);
  signal.value = signal.state == RawState::kValid ? raw : 0U;
}

template <class E>
constexpr void from_raw(const Field& field, std::uint32_t raw, Coded<E>& signal) {
  signal.state = classify(field, raw);
  signal.value = signal.state == RawState::kValid ? static_cast<E>(raw) : E{};
}

/// Rounds to the nearest raw value and saturates into [min|max]; NaN and infinities are refused.
constexpr std::uint32_t to_raw(const Field& field, const Physical& signal) {
  if (signal.state != RawState::kValid) {
    return special_raw(field, signal.state);
  }
  constexpr double kLargest = std::numeric_limits<double>::max();
  if (!(signal.value >= -kLargest && signal.value <= kLargest)) {
    return refused_raw(field);
  }
  const double raw =
      signal.value / field.numerator * field.denominator - static_cast<double>(field.raw_offset);
  if (raw <= static_cast<double>(field.raw_min)) {
    return field.raw_min;
  }
  if (raw >= static_cast<double>(field.raw_max)) {
    return field.raw_max;
  }
  // std::lround is not constexpr; here raw is positive and far below 2^52, where adding 0.5 rounds.
  return static_cast<std::uint32_t>(raw + 0.5);  // NOLINT(bugprone-incorrect-roundings)
}

/// Saturates into [min|max].
constexpr std::uint32_t to_raw(const Field& field, const Count& signal) {
  if (signal.state != RawState::kValid) {
    return special_raw(field, signal.state);
  }
  return signal.value < field.raw_min   ? field.raw_min
         : signal.value > field.raw_max ? field.raw_max
                                        : signal.value;
}

/// A number that the value table lacks is refused: a neighbouring state would be a lie.
template <class E>
constexpr std::uint32_t to_raw(const Field& field, const Coded<E>& signal) {
  if (signal.state != RawState::kValid) {
    return special_raw(field, signal.state);
  }
  const auto raw = static_cast<std::uint32_t>(signal.value);
  return raw >= field.raw_min && raw <= field.raw_max ? raw : refused_raw(field);
}

template <class Message>
constexpr Message decode_message(const Payload& payload) {
  Message message{};
  Message::visit(message, [&payload](const Field& field, auto& signal) {
    from_raw(field, extract(payload, field.start_bit, field.width), signal);
  });
  return message;
}

/// Bits of no signal are 1; so are CRC and counter until the end-to-end protection fills them in
/// (a counter of 15 is invalid: a frame whose protection was forgotten is refused everywhere).
template <class Message>
constexpr Payload encode_message(const Message& message) {
  Payload payload{};
  for (std::uint8_t& byte : payload) {
    byte = 0xFF;
  }
  Message::visit(message, [&payload](const Field& field, const auto& signal) {
    insert(payload, field.start_bit, field.width, to_raw(field, signal));
  });
  return payload;
}

}  // namespace graben::dbc
