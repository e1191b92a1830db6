// SPDX-License-Identifier: Apache-2.0
// The claim of an address by SAE J1939-81, with frames written out by its layout: who keeps it, who
// loses it, and what a storm of claims brings.

#include <array>
#include <cstdint>
#include <optional>
#include <random>

#include "hal/j1939/address_claim.hpp"
#include "hal/j1939/ids.hpp"
#include "tests/unit/cmocka_cpp.hpp"

using namespace graben::j1939;

constexpr std::uint8_t kOwn = 130;
constexpr std::uint64_t kName = 0x3000FF0000012345;
constexpr std::uint32_t kOurClaim = 0x18EEFF82;
constexpr std::uint32_t kCannot = 0x18EEFFFE;

CanFrame frame_of(std::uint32_t id, std::uint64_t data, std::uint8_t length = 8) {
  CanFrame frame;
  frame.id = id;
  frame.length = length;
  for (std::size_t i = 0; i < 8; ++i) {
    frame.data[i] = static_cast<std::uint8_t>(data >> (8 * i));
  }
  return frame;
}

// A station on its bus, looked at each 10 ms.
struct Station {
  AddressClaim claim{kOwn, kName};
  TimeUs now = 0;

  // The frame of the next cycle, if there is one.
  std::optional<CanFrame> cycle() {
    now += 10 * kMillisecondUs;
    CanFrame frame;
    if (!claim.due(now, frame)) {
      return std::nullopt;
    }
    claim.tried(now, true);
    return frame;
  }
  // Frames in so many seconds; the last one in `last`.
  int run(double seconds, CanFrame* last = nullptr) {
    int count = 0;
    for (int i = 0; i < static_cast<int>(seconds * 100.0 + 0.5); ++i) {
      if (const auto frame = cycle()) {
        ++count;
        if (last != nullptr) {
          *last = *frame;
        }
      }
    }
    return count;
  }
  void hear(std::uint32_t id, std::uint64_t data, std::uint8_t length = 8) {
    claim.hear(frame_of(id, data, length), now);
  }
};

// The bytes of a NAME are sent with the lowest first: identity, manufacturer, function, group.
TEST(name_and_frame) {
  assert_int_equal(name_of({0x12345, 0}), kName);
  assert_int_equal(name_of({0xFFFFFFFF, 0xFFFF}), 0x3000FF00FFFFFFFF);
  Station station;
  const auto frame = station.cycle();
  assert_true(frame.has_value());
  assert_int_equal(frame->id, kOurClaim);
  assert_true(frame->extended);
  assert_int_equal(frame->length, 8);
  const std::array<std::uint8_t, 8> wanted = {0x45, 0x23, 0x01, 0, 0, 0xFF, 0, 0x30};
  assert_memory_equal(frame->data.data(), wanted.data(), 8);
  assert_int_equal(station.run(10.0), 0);
}

// What the bus does not take is tried again, and a bus that is back hears it anew.
TEST(claimed_until_taken) {
  Station station;
  CanFrame frame;
  int tried = 0;
  for (int i = 0; i < 1000; ++i) {
    station.now += 10 * kMillisecondUs;
    if (station.claim.due(station.now, frame)) {
      station.claim.tried(station.now, false);
      ++tried;
    }
  }
  assert_in_range(tried, 45, 51);
  assert_int_equal(station.run(1.0), 1);
  assert_int_equal(station.run(1.0), 0);
  station.claim.begin();
  assert_int_equal(station.run(1.0), 1);
}

TEST(requests_are_answered) {
  for (const std::uint32_t id : {0x18EAFFF9U, 0x18EA82F9U, 0x18EAFFFEU}) {
    Station station;
    static_cast<void>(station.run(2.0));
    station.hear(id, 0xEE00, 3);
    CanFrame frame;
    assert_int_equal(station.run(1.0, &frame), 1);
    assert_int_equal(frame.id, kOurClaim);
  }
  Station station;
  static_cast<void>(station.run(2.0));
  station.hear(0x18EA83F9, 0xEE00, 3);  // another's
  station.hear(0x18EAFFF9, 0xFECA, 3);  // another group
  station.hear(0x18EAFFF9, 0xEE00, 2);  // cut
  assert_int_equal(station.run(1.0), 0);
}

// A higher name gives way to us; we say so at once.
TEST(higher_name_gives_way) {
  Station station;
  static_cast<void>(station.run(2.0));
  station.hear(kOurClaim, kName + 1);
  const auto frame = station.cycle();
  assert_true(frame.has_value());
  assert_int_equal(frame->id, kOurClaim);
  assert_false(station.claim.is_lost());
  assert_int_equal(station.claim.defended(), 1);
  assert_int_equal(station.claim.rival().name, kName + 1);
}

// A lower name has the address, and the same one too: two of one name can't both be told apart.
TEST(lower_or_same_name_wins) {
  for (const std::uint64_t rival : {kName, kName - 1, std::uint64_t{0}}) {
    Station station;
    static_cast<void>(station.run(2.0));
    station.hear(kOurClaim, rival);
    assert_true(station.claim.is_lost());
    CanFrame frame;
    assert_int_equal(station.run(0.16, &frame), 1);  // within 153 ms
    assert_int_equal(frame.id, kCannot);
    assert_int_equal(frame.data[0], 0x45);
    // Asked again, the same; a rival that gives way does not bring it back.
    station.hear(0x18EAFFF9, 0xEE00, 3);
    assert_int_equal(station.run(0.16, &frame), 1);
    assert_int_equal(frame.id, kCannot);
    station.hear(kOurClaim, kName + 1);
    station.claim.begin();
    assert_true(station.claim.is_lost());
    assert_int_equal(station.run(2.0, &frame), 1);
    assert_int_equal(frame.id, kCannot);
  }
}

// Before anybody could object it is the same.
TEST(lost_at_the_start) {
  Station station;
  station.hear(kOurClaim, 1);
  assert_true(station.claim.is_lost());
  CanFrame frame;
  assert_int_equal(station.run(0.2, &frame), 1);
  assert_int_equal(frame.id, kCannot);
}

// Others' claims, cut ones, and what only looks like a claim.
TEST(no_claim_of_ours) {
  Station station;
  static_cast<void>(station.run(2.0));
  station.hear(0x18EEFF83, 0);
  station.hear(0x18EEFFFE, 0);
  station.hear(kOurClaim, 0, 7);
  CanFrame frame = frame_of(kOurClaim, 0);
  frame.remote = true;
  station.claim.hear(frame, station.now);
  frame.remote = false;
  frame.extended = false;
  station.claim.hear(frame, station.now);
  frame.extended = true;
  frame.fd = true;
  station.claim.hear(frame, station.now);
  frame.fd = false;
  frame.error = true;
  station.claim.hear(frame, station.now);
  assert_false(station.claim.is_lost());
  assert_int_equal(station.run(1.0), 0);
}

// At any priority: it is the group that counts.
TEST(priority_is_the_senders) {
  Station station;
  station.hear(0x00EEFF82, 0);
  assert_true(station.claim.is_lost());
}

// 1000 claims a second, of names higher than ours, and requests between them: ours goes out five
// times a second, and the address stays.
TEST(storm) {
  std::mt19937_64 random(7);
  Station station;
  int sent = 0;
  repeat(1000, [&] {
    for (int i = 0; i < 10; ++i) {
      station.hear(kOurClaim, kName + 1 + random() % 1'000'000);
      station.hear(0x18EAFFF9, 0xEE00, 3);
    }
    sent += station.cycle() ? 1 : 0;
  });
  assert_false(station.claim.is_lost());
  assert_in_range(sent, 45, 55);
  assert_int_equal(station.claim.defended(), 10'000);
}
