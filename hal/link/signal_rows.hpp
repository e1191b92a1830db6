// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Where the signals of a message lie, as rows of a table that one function unpacks and one packs.
/// The rows are made of the generated fields when the program is compiled. Each message's own codec
/// (can_dbc/codec.hpp) says the same, faster and for three times the flash.

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "can_dbc/codec.hpp"
#include "firmware/core/whole.hpp"

namespace graben {

/// What raw values of a signal mean; signals that mean the same share one.
/// Special values are those of J1939: the first bits, 8 at most, are all 1 for 'not available', and
/// one less for 'error'.
struct SignalScale {
  double numerator = 1.0;  ///< As dbc::Field has them.
  double denominator = 1.0;
  std::int32_t raw_offset = 0;
  std::uint32_t raw_min = 0;
  std::uint32_t raw_max = 0;
  std::uint32_t mask = 0;       ///< Of the signal's width.
  std::uint16_t error_top = 0;  ///< The first bits of 'error'; kNoSpecials: it has none.
  std::uint8_t top_shift = 0;   ///< Bits below the first ones.

  static constexpr std::uint16_t kNoSpecials = 0xFFFF;
};

constexpr bool operator==(const SignalScale& a, const SignalScale& b) {
  return a.numerator == b.numerator && a.denominator == b.denominator &&
         a.raw_offset == b.raw_offset && a.raw_min == b.raw_min && a.raw_max == b.raw_max &&
         a.mask == b.mask && a.error_top == b.error_top && a.top_shift == b.top_shift;
}

/// What a member of a message is.
enum class SignalKind : std::uint8_t { kPhysical, kCount, kCoded };

/// A signal of a message.
struct SignalRow {
  const SignalScale* scale = nullptr;
  std::uint8_t start_bit = 0;
  SignalKind kind = SignalKind::kPhysical;
  std::uint16_t offset = 0;  ///< Of its member in the message.
};

/// Reads `count` signals of `payload` into the message at `message`. False if a value is out of
/// range.
[[nodiscard]] bool unpack(const SignalRow* rows, std::size_t count, const dbc::Payload& payload,
                          void* message);
/// The payload that `count` signals of the message at `message` make; other bits are 1.
[[nodiscard]] dbc::Payload pack(const SignalRow* rows, std::size_t count, const void* message);

namespace rows {

/// Where a coded member has its state, behind its value.
inline constexpr std::size_t kCodedState = offsetof(dbc::Coded<std::uint8_t>, state);

/// A member of a message: all of them are one of these.
constexpr SignalKind kind_of(const dbc::Physical&) { return SignalKind::kPhysical; }
constexpr SignalKind kind_of(const dbc::Count&) { return SignalKind::kCount; }
template <class E>
constexpr SignalKind kind_of(const dbc::Coded<E>&) {
  static_assert(sizeof(E) == 1 && offsetof(dbc::Coded<E>, state) == kCodedState);
  return SignalKind::kCoded;
}

/// Bits below the first ones (dbc::says).
constexpr std::uint8_t top_shift(unsigned width) {
  return static_cast<std::uint8_t>(width < 16U ? 0U : width - 8U);
}

constexpr SignalScale scale_of(const dbc::Field& field) {
  SignalScale scale;
  scale.numerator = field.numerator;
  scale.denominator = field.denominator;
  scale.raw_offset = field.raw_offset;
  scale.raw_min = field.raw_min;
  scale.raw_max = field.raw_max;
  scale.mask = static_cast<std::uint32_t>((std::uint64_t{1} << field.width) - 1U);
  scale.top_shift = top_shift(field.width);
  const bool specials = field.error_raw >= 0;
  scale.error_top = specials ? static_cast<std::uint16_t>((scale.mask >> scale.top_shift) - 1U)
                             : SignalScale::kNoSpecials;
  return scale;
}

/// Whether a row can say what the field says: its specials are J1939's, beyond all valid values, or
/// none, and the counts of a physical value fit 32 bits.
constexpr bool fits(const dbc::Field& field, SignalKind kind) {
  const SignalScale scale = scale_of(field);
  const std::int64_t all = scale.mask;
  const bool special = field.error_raw == all - (std::int64_t{1} << scale.top_shift) &&
                       field.not_available_raw == all &&
                       (field.raw_max >> scale.top_shift) < scale.error_top;
  const bool none = field.error_raw < 0 && field.not_available_raw < 0 && field.start_raw == 0;
  const std::int64_t most = std::int64_t{field.raw_max} + field.raw_offset;
  return (special || none) &&
         (kind != SignalKind::kPhysical || (field.raw_max <= INT32_MAX && most <= INT32_MAX)) &&
         (kind != SignalKind::kCoded || field.raw_max <= UINT8_MAX);
}

template <class Message, class Visitor>
constexpr void visit_start(const Visitor& visitor) {
  const Message message{};
  Message::visit(message, visitor);
}

template <class Message>
constexpr std::size_t count_of() {
  std::size_t count = 0;
  const Message message{};
  Message::visit(message, [&count](const dbc::Field&, const auto&) { ++count; });
  return count;
}

/// Distinct scales of some messages.
template <std::size_t room>
struct Scales {
  std::array<SignalScale, room> scale{};
  std::size_t count = 0;

  constexpr std::size_t place(const SignalScale& wanted) const {
    std::size_t n = 0;
    while (n < count && !(scale[n] == wanted)) {
      ++n;
    }
    return n;
  }
  constexpr void add(const SignalScale& wanted) {
    const std::size_t n = place(wanted);
    if (n == count) {
      scale[n] = wanted;
      ++count;
    }
  }
};

template <class... Messages>
constexpr auto scales_of(dbc::MessageList<Messages...>) {
  Scales<(count_of<Messages>() + ...)> all;
  const auto add = [&all](const dbc::Field& field, const auto&) { all.add(scale_of(field)); };
  (visit_start<Messages>(add), ...);
  return all;
}

}  // namespace rows

/// A message that is to be read: its start values are not written first, as reading writes each
/// member.
template <class Message>
union UnreadMessage {
  UnreadMessage() {}  // NOLINT(modernize-use-equals-default): that would be a deleted one
  Message message;
};

/// Rows of the messages of a bus, which share their scales; `Messages` is its list.
template <class Messages>
struct SignalRows {
 private:
  static constexpr auto kAll = rows::scales_of(Messages{});

  static constexpr auto used() {
    std::array<SignalScale, kAll.count> scales{};
    for (std::size_t n = 0; n < scales.size(); ++n) {
      scales[n] = kAll.scale[n];
    }
    return scales;
  }
  static constexpr auto kScales = used();

  /// Members lie in the order of the fields, each where its alignment allows.
  template <class Message>
  static constexpr auto made() {
    struct {
      std::array<SignalRow, rows::count_of<Message>()> row{};
      std::size_t end = 0;
      bool good = true;
    } of;
    std::size_t n = 0;
    const Message message{};
    Message::visit(message, [&of, &n](const dbc::Field& field, const auto& signal) {
      using Member = std::decay_t<decltype(signal)>;
      const std::size_t at = (of.end + alignof(Member) - 1) / alignof(Member) * alignof(Member);
      const SignalKind kind = rows::kind_of(signal);
      of.row[n] = {&kScales[kAll.place(rows::scale_of(field))], field.start_bit, kind,
                   static_cast<std::uint16_t>(at)};
      of.good = of.good && rows::fits(field, kind);
      of.end = at + sizeof(Member);
      ++n;
    });
    return of;
  }

 public:
  /// Rows of one of them.
  template <class Message>
  static constexpr auto rows_of() {
    constexpr auto kMade = made<Message>();
    static_assert(kMade.good, "a field that no row can say");
    constexpr std::size_t kAligned = alignof(Message);
    static_assert((kMade.end + kAligned - 1) / kAligned * kAligned == sizeof(Message),
                  "a member that is no signal");
    return kMade.row;
  }
  template <class Message>
  static constexpr auto kRows = rows_of<Message>();

  /// As decode(), by the rows.
  template <class Message>
  [[nodiscard]] static bool unpacked(const dbc::Payload& payload, Message& message) {
    return unpack(kRows<Message>.data(), kRows<Message>.size(), payload, &message);
  }
  /// As encode(), by the rows.
  template <class Message>
  [[nodiscard]] static dbc::Payload packed(const Message& message) {
    return pack(kRows<Message>.data(), kRows<Message>.size(), &message);
  }

  /// As Message::decode; false if a value is out of range. A processor with wide registers has the
  /// flash for each message's own code, which is faster.
  template <class Message>
  [[nodiscard]] static bool decode(const dbc::Payload& payload, Message& message) {
    if constexpr (kWideRegisters) {
      message = Message::decode(payload);
      bool all = true;
      Message::visit(message, [&all](const dbc::Field&, const auto& signal) {
        all = all && signal.state != dbc::RawState::kOutOfRange;
      });
      return all;
    } else {
      return unpacked(payload, message);
    }
  }
  /// As Message::encode.
  template <class Message>
  [[nodiscard]] static dbc::Payload encode(const Message& message) {
    if constexpr (kWideRegisters) {
      return message.encode();
    } else {
      return packed(message);
    }
  }
};

}  // namespace graben
