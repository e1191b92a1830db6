// SPDX-License-Identifier: Apache-2.0
// Rows of signals against the constant codec of the same message, which unit_dbc_codec holds
// against the DBC: byte for byte, bit for bit.

#include "hal/link/signal_rows.hpp"

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "can_dbc/generated/dozer_dbc.hpp"
#include "can_dbc/generated/excavator_dbc.hpp"
#include "can_dbc/generated/j1939_dbc.hpp"
#include "tests/unit/cmocka_cpp.hpp"

using graben::dbc::Coded;
using graben::dbc::Count;
using graben::dbc::Field;
using graben::dbc::Payload;
using graben::dbc::Physical;
using graben::dbc::RawState;

constexpr int kTrials = 400;
using Random = std::mt19937;

// Raw values where something changes, and any others.
std::uint32_t some_raw(const Field& field, Random& random) {
  const std::uint64_t all = (std::uint64_t{1} << field.width) - 1U;
  const std::uint64_t top = std::uint64_t{1} << (field.width < 16 ? 0 : field.width - 8);
  const std::uint64_t edges[] = {
      0,         field.raw_min, field.raw_min - 1ULL, field.raw_max, field.raw_max + 1ULL,
      all - top, all,           all - 2 * top,        all - top + 1, random()};
  return static_cast<std::uint32_t>(edges[random() % std::size(edges)] & all);
}

double some_value(const Field& field, Random& random) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double least = dbc::physical_of(field, field.raw_min);
  const double most = dbc::physical_of(field, field.raw_max);
  const double share = static_cast<double>(random()) / 4294967295.0;
  const double values[] = {least,         most,         least + share * (most - least),
                           least - share, most + share, std::numeric_limits<double>::max(),
                           -kInfinity,    kInfinity,    std::nan("")};
  return values[random() % std::size(values)];
}

void fill(const Field& field, Random& random, Physical& signal) {
  signal.value = some_value(field, random);
}
void fill(const Field& field, Random& random, Count& signal) {
  signal.value = random() % 2 == 0 ? some_raw(field, random) : static_cast<std::uint32_t>(random());
}
template <class E>
void fill(const Field& field, Random& random, Coded<E>& signal) {
  signal.value = static_cast<E>(some_raw(field, random));
}

bool same(const Physical& a, const Physical& b) {
  return std::memcmp(&a.value, &b.value, sizeof a.value) == 0 && a.state == b.state;
}
template <class Signal>
bool same(const Signal& a, const Signal& b) {
  return a.value == b.value && a.state == b.state;
}

template <class Rows, class Message>
void check_decode(Random& random) {
  Payload payload{};
  for (std::uint8_t& byte : payload) {
    byte = static_cast<std::uint8_t>(random());
  }
  Message wanted{};
  bool good = true;
  Message::visit(wanted, [&](const Field& field, const auto&) {
    dbc::insert(payload, field.start_bit, field.width, some_raw(field, random));
  });
  wanted = Message::decode(payload);
  Message found{};
  const bool all = Rows::unpacked(payload, found);
  Message again{};
  assert_true(Rows::decode(payload, again) == all);
  Message::visit(wanted, [&](const Field& field, const auto& signal) {
    good = good && signal.state != RawState::kOutOfRange;
    Message::visit(found, [&](const Field& other, const auto& read) {
      if constexpr (std::is_same_v<decltype(read), decltype(signal)>) {
        if (&other == &field && !same(read, signal)) {
          fail_msg("%s.%s is read as something else", Message::kName, field.name);
        }
      }
    });
  });
  if (all != good) {
    fail_msg("%s is %s by its rows", Message::kName, all ? "in range" : "out of range");
  }
}

template <class Rows, class Message>
void check_encode(Random& random) {
  Message message{};
  Message::visit(message, [&](const Field& field, auto& signal) {
    fill(field, random, signal);
    constexpr RawState kStates[] = {RawState::kValid, RawState::kValid, RawState::kOutOfRange,
                                    RawState::kError, RawState::kNotAvailable};
    signal.state = kStates[random() % std::size(kStates)];
  });
  if (Rows::packed(message) != message.encode() || Rows::encode(message) != message.encode()) {
    fail_msg("%s is sent as something else", Message::kName);
  }
  if (Rows::packed(Message{}) != Message{}.encode()) {
    fail_msg("%s that nobody has filled in is something else", Message::kName);
  }
}

template <class... Messages>
void check_all(dbc::MessageList<Messages...> all) {
  using Rows = SignalRows<decltype(all)>;
  Random random(52);  // NOLINT(cert-msc32-c,cert-msc51-cpp): the same each time
  for (int n = 0; n < kTrials; ++n) {
    (check_decode<Rows, Messages>(random), ...);
    (check_encode<Rows, Messages>(random), ...);
  }
}

TEST(an_excavators_rows_say_what_its_codec_says) { check_all(dbc::excavator::AllMessages{}); }

TEST(a_dozers_rows_say_what_its_codec_says) { check_all(dbc::dozer::AllMessages{}); }

TEST(an_imus_rows_say_what_its_codec_says) {
  check_all(dbc::MessageList<dbc::j1939::ARI, dbc::j1939::ACS>{});
}
