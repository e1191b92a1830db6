// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Walks over every signal of a database, against a hand-written table of scales.

#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <type_traits>

#include "can_dbc/codec.hpp"
#include "tests/unit/cmocka_cpp.hpp"

namespace graben::codec_test {

using namespace graben::dbc;

// SI value = raw * factor + offset within [min, max].
struct Scale {
  const char* name;
  double factor;
  double offset;
  double min;
  double max;
};

inline constexpr double kPi = 3.14159265358979323846;

template <class Scales>
const Scale& scale_of(const Scales& scales, const char* name) {
  for (const Scale& scale : scales) {
    if (std::strcmp(scale.name, name) == 0) {
      return scale;
    }
  }
  fail_msg("no scale for %s", name);
  return *std::begin(scales);
}

// Calls check(message, field, signal) for each signal of each message; `message` is a filled-in
// default that check may change.
template <class Message, class Check>
void for_signals(Check check) {
  Message message;
  Message::visit(message, [&](const Field& field, auto& signal) {
    const auto initial = signal;
    check(message, field, signal);
    signal = initial;
  });
}

template <class Check, class... Messages>
void for_all(MessageList<Messages...>, Check check) {
  (for_signals<Messages>(check), ...);
}

// Hashes, bit fields and the parts of a trouble code use their whole width.
inline bool has_specials(const Field& field) {
  for (const char* name : {"ProfileHash", "WhyNotArmed", "SpnLow", "SpnHigh", "Fmi",
                           "OccurrenceCount", "ConversionMethod"}) {
    if (std::strcmp(field.name, name) == 0) {
      return false;
    }
  }
  return true;
}

// The J1939 ranges, told without the generated constants.
inline RawState j1939_state(const Field& field, std::uint32_t raw) {
  if (!has_specials(field)) {
    return RawState::kValid;
  }
  const std::uint32_t top = field.width >= 16 ? raw >> (field.width - 8U) : raw;
  const std::uint32_t not_available = field.width >= 8 ? 0xFFU : (1U << field.width) - 1U;
  if (top == not_available) {
    return RawState::kNotAvailable;
  }
  return top == not_available - 1U ? RawState::kError : RawState::kValid;
}

template <class Message>
auto decoded(const Field& wanted, std::uint32_t raw, Payload& payload) {
  payload.fill(0xFF);
  insert(payload, wanted.start_bit, wanted.width, raw);
  return Message::decode(payload);
}

template <class Scales>
void check_value(const Scales& scales, const Field& field, std::uint32_t raw,
                 const Physical& signal) {
  const Scale& scale = scale_of(scales, field.name);
  const double expected = raw * scale.factor + scale.offset;
  const bool inside =
      expected >= scale.min - 1e-9 * scale.max && expected <= scale.max * (1 + 1e-9);
  RawState state = j1939_state(field, raw);
  if (state == RawState::kValid && !inside) {
    state = RawState::kOutOfRange;
  }
  assert_int_equal(signal.state, state);
  assert_near(signal.value, state == RawState::kValid ? expected : 0.0, 1e-12 * scale.max);
}

template <class Scales, class Plain>
void check_value(const Scales&, const Field& field, std::uint32_t raw, const Plain& signal) {
  if (j1939_state(field, raw) != RawState::kValid) {
    assert_int_equal(signal.state, j1939_state(field, raw));
    assert_int_equal(static_cast<std::uint32_t>(signal.value), 0);
  } else if (signal.state == RawState::kValid) {
    assert_int_equal(static_cast<std::uint32_t>(signal.value), raw);
  } else {
    assert_int_equal(signal.state, RawState::kOutOfRange);
    assert_true(raw > field.raw_max);
  }
}

// Every signal over its whole raw range; `Messages` is a database's AllMessages.
template <class Messages, class Scales>
void check_every_raw_value(const Scales& scales, int expected_signals) {
  int signals = 0;
  for_all(Messages{}, [&](auto& message, const Field& field, auto&) {
    using Message = std::remove_reference_t<decltype(message)>;
    ++signals;
    const std::uint64_t end = std::uint64_t{1} << field.width;
    const std::uint64_t step = field.width == 32 ? 65521 : 1;
    for (std::uint64_t raw64 = 0; raw64 < end; raw64 += step) {
      const auto raw = static_cast<std::uint32_t>(raw64);
      Payload payload{};
      const Message read = decoded<Message>(field, raw, payload);
      Message::visit(read, [&](const Field& other, const auto& signal) {
        if (std::strcmp(other.name, field.name) == 0) {
          check_value(scales, field, raw, signal);
          if (signal.state == RawState::kValid) {
            // All other bits are 1, as 'not available' and unused bits are: nothing else may
            // change.
            assert_memory_equal(read.encode().data(), payload.data(), payload.size());
          }
        }
      });
    }
  });
  assert_int_equal(signals, expected_signals);
}

template <class Message>
std::uint32_t sent(const Message& message, const Field& field) {
  return extract(message.encode(), field.start_bit, field.width);
}

template <class Messages, class Scales>
void check_saturation_and_refusal(const Scales& scales) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for_all(Messages{}, [&](auto& message, const Field& field, auto& signal) {
    const auto not_available = static_cast<std::uint32_t>((std::uint64_t{1} << field.width) - 1U);
    const std::uint32_t error = not_available - (field.width < 16 ? 1U : 1U << (field.width - 8U));
    const bool has_special = has_specials(field);
    signal.state = RawState::kError;
    assert_int_equal(sent(message, field), has_special ? error : field.start_raw);
    signal.state = RawState::kOutOfRange;
    assert_int_equal(sent(message, field), has_special ? error : field.start_raw);
    signal.state = RawState::kNotAvailable;
    assert_int_equal(sent(message, field), has_special ? not_available : field.start_raw);
    signal.state = RawState::kValid;
    if constexpr (std::is_same_v<std::remove_reference_t<decltype(signal)>, Physical>) {
      const Scale& scale = scale_of(scales, field.name);
      const auto low =
          static_cast<std::uint32_t>(std::lround((scale.min - scale.offset) / scale.factor));
      const auto high =
          static_cast<std::uint32_t>(std::lround((scale.max - scale.offset) / scale.factor));
      for (const double beyond : {scale.max, scale.max * 1.0001, 1e9 * scale.max, 1.7e308}) {
        signal.value = beyond;
        assert_int_equal(sent(message, field), high);
      }
      for (const double beyond :
           {scale.min, scale.min - scale.factor, -1e9 * scale.max, -1.7e308}) {
        signal.value = beyond;
        assert_int_equal(sent(message, field), low);
      }
      for (const double no_value : {kNan, kInfinity, -kInfinity}) {
        signal.value = no_value;
        assert_int_equal(sent(message, field), error);
      }
      // Nearest, not truncated.
      signal.value = (low + 40.4) * scale.factor + scale.offset;
      assert_int_equal(sent(message, field), low + 40U);
      signal.value = (low + 40.6) * scale.factor + scale.offset;
      assert_int_equal(sent(message, field), low + 41U);
    }
  });
}

template <class Message>
void assert_encodes(const Message& message, const Payload& bytes) {
  assert_memory_equal(message.encode().data(), bytes.data(), bytes.size());
}

// What nobody has filled in carries the start values.
template <class Messages>
void check_start_values() {
  for_all(Messages{}, [](auto& message, const Field& field, auto&) {
    assert_int_equal(sent(message, field), field.start_raw);
  });
}

}  // namespace graben::codec_test
