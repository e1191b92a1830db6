// SPDX-License-Identifier: Apache-2.0
/// Keys that a terminal repeats, and when they count as held.

#include "app/operate/keyboard.hpp"

#include <string_view>

#include "tests/unit/cmocka_cpp.hpp"

using operate::Hands;
using operate::KeyHold;

constexpr TimeUs kCycle_us = 20 * kMillisecondUs;

/// A key that is held, as a terminal tells it: at once, after 500 ms, then every 40 ms; from
/// `from_us` to before `to_us`. Returns how long after `to_us` the deadman still counted.
TimeUs hold(KeyHold& keys, char key, TimeUs from_us, TimeUs to_us) {
  TimeUs next_us = from_us;
  for (TimeUs now = from_us;; now += kCycle_us) {
    std::string_view bytes;
    if (now >= next_us && now < to_us) {
      bytes = {&key, 1};
      next_us = now + (next_us == from_us ? 500 : 40) * kMillisecondUs;
    }
    if (!keys.step(bytes, now).deadman) {
      assert_true(now >= to_us);
      return now - to_us;
    }
  }
}

TEST(a_held_key_is_held_all_the_time) {
  KeyHold keys;
  const TimeUs late_us = hold(keys, ' ', kSecondUs, 5 * kSecondUs);
  assert_true(late_us <= KeyHold::kRepeat_us + kCycle_us);
}

TEST(a_tapped_key_ends_after_the_first_time) {
  KeyHold keys;
  const TimeUs late_us = hold(keys, ' ', kSecondUs, kSecondUs + kCycle_us);
  assert_true(late_us <= KeyHold::kFirst_us);
  assert_true(late_us > KeyHold::kRepeat_us);
}

TEST(a_repeating_key_that_stops_ends_soon) {
  KeyHold keys;
  assert_true(keys.step(" ", 0).deadman);
  assert_true(keys.step(" ", 500 * kMillisecondUs).deadman);
  assert_true(keys.step("", 500 * kMillisecondUs + KeyHold::kRepeat_us - 1).deadman);
  assert_false(keys.step("", 500 * kMillisecondUs + KeyHold::kRepeat_us).deadman);
  // And is not held again by itself.
  assert_false(keys.step("", 510 * kMillisecondUs).deadman);
}

TEST(a_lever_key_takes_over_from_space) {
  KeyHold keys;
  assert_true(keys.step(" ", 0).levers.are_at_rest());
  Hands hands = keys.step("k", 100 * kMillisecondUs);
  assert_true(hands.deadman);
  assert_near(hands.levers.right.away_ratio, -1.0, 0.0);
  // Back to rest, still held.
  hands = keys.step(" ", 200 * kMillisecondUs);
  assert_true(hands.deadman);
  assert_true(hands.levers.are_at_rest());
  hands = keys.step("e", 300 * kMillisecondUs);
  assert_near(hands.levers.left.away_ratio, 1.0, 0.0);
  assert_near(keys.step("d", 310 * kMillisecondUs).levers.left.away_ratio, -1.0, 0.0);
  assert_near(keys.step("s", 320 * kMillisecondUs).levers.left.right_ratio, -1.0, 0.0);
  assert_near(keys.step("f", 330 * kMillisecondUs).levers.left.right_ratio, 1.0, 0.0);
  assert_near(keys.step("i", 340 * kMillisecondUs).levers.right.away_ratio, 1.0, 0.0);
  assert_near(keys.step("j", 350 * kMillisecondUs).levers.right.right_ratio, -1.0, 0.0);
  assert_near(keys.step("l", 360 * kMillisecondUs).levers.right.right_ratio, 1.0, 0.0);
}

TEST(any_other_key_lets_go) {
  for (const char* const other : {"x", "\x1b", "\r", "q"}) {
    KeyHold keys;
    assert_true(keys.step(" ", 0).deadman);
    const Hands hands = keys.step(other, kCycle_us);
    assert_false(hands.deadman);
    assert_true(hands.quits == (*other == 'q'));
  }
}

TEST(commands_do_not_hold) {
  KeyHold keys;
  const Hands hands = keys.step("mt++-", 0);
  assert_true(hands.changes_mode && hands.changes_task);
  assert_int_equal(hands.speed_steps, 1);
  assert_false(hands.deadman);
  // Twice is back again.
  assert_false(keys.step("mm", kCycle_us).changes_mode);
}

TEST(the_marks_key_is_a_press_that_lets_nothing_go) {
  KeyHold keys;
  assert_true(keys.step(" ", 0).deadman);
  Hands hands = keys.step("p", 20 * kMillisecondUs);
  assert_true(hands.touches == TouchKind::kMark && hands.deadman);
  assert_false(keys.step("", 40 * kMillisecondUs).touches.has_value());
}
