// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A receiver of one protected message, for the tests of the end-to-end protection.

#include "hal/link/e2e.hpp"
#include "tests/unit/cmocka_cpp.hpp"

namespace graben::test {

inline constexpr std::uint16_t kDataId = 0x123;
inline constexpr TimeUs kCycleUs = 10'000;
inline constexpr E2eConfig kConfig{kDataId, 3, 4 * kCycleUs, kCycleUs};

inline E2ePayload frame(std::uint8_t counter) {
  E2ePayload payload{};
  e2e_protect(payload, kDataId, counter);
  return payload;
}

// Another frame than frame(counter), and its CRC another one.
inline E2ePayload other_frame(std::uint8_t counter) {
  E2ePayload payload{0, 0, 1};
  e2e_protect(payload, kDataId, counter);
  assert_int_not_equal(payload[0], frame(counter)[0]);
  return payload;
}

// A receiver and its clock: each frame comes one cycle after the last.
struct Link {
  E2eState state;
  TimeUs now = 1'000'000;

  E2eCheck take(std::uint8_t counter) { return take(frame(counter)); }
  E2eCheck take(const E2ePayload& payload) {
    now += kCycleUs;
    return e2e_check(kConfig, state, payload, now);
  }
  void wait(TimeUs time_us) { now += time_us; }
  // Takes these one after the other, each with its result.
  void expect(std::uint8_t first, std::initializer_list<E2eCheck> checks) {
    for (const E2eCheck check : checks) {
      assert_int_equal(take(first), check);
      first = e2e_next_counter(first);
    }
  }
  // Two frames of this counter and the next begin, the third is accepted.
  void expect_synchronising(std::uint8_t first) {
    expect(first, {E2eCheck::kSynchronising, E2eCheck::kSynchronising, E2eCheck::kOk});
  }
};

inline Link synchronised_at(std::uint8_t counter) {
  Link link;
  for (unsigned back = 3; back-- > 0;) {
    (void)link.take(static_cast<std::uint8_t>((counter + kE2eCounterCount - back) % 15U));
  }
  assert_true(link.state.synchronised);
  return link;
}

inline constexpr int kFarTooMany = 15;

// Takes frames at one moment until one is too early; returns how many were not.
inline int frames_at_once(Link& link, std::uint8_t counter) {
  for (int taken = 0; taken < kFarTooMany; ++taken) {
    const E2eCheck check = e2e_check(kConfig, link.state, frame(counter), link.now);
    if (check == E2eCheck::kTooMany) {
      assert_false(e2e_accepted(check));
      assert_true(link.state.synchronised);
      assert_int_equal(link.state.last_counter, (counter + 14) % 15);
      return taken;
    }
    assert_true(e2e_accepted(check));
    counter = e2e_next_counter(counter);
  }
  return kFarTooMany;
}

}  // namespace graben::test
