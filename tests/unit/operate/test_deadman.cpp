// SPDX-License-Identifier: Apache-2.0
/// When enable is given, and when not again.

#include "app/operate/deadman.hpp"

#include <array>

#include "tests/unit/cmocka_cpp.hpp"

using operate::Deadman;
using operate::Trouble;
using operate::trouble_words;

constexpr std::array<Trouble, 7> kTroubles = {
    Trouble::kDeviceGone, Trouble::kEventsLost, Trouble::kDeviceSilent, Trouble::kStationLate,
    Trouble::kBus,        Trouble::kEcuSilent,  Trouble::kOtherDbc};

bool press(Deadman& deadman) { return deadman.step(true, true, Trouble::kNone); }
bool release(Deadman& deadman) { return deadman.step(false, true, Trouble::kNone); }

TEST(it_is_on_from_press_to_release) {
  Deadman deadman;
  assert_false(release(deadman));
  assert_true(press(deadman));
  assert_true(press(deadman));
  // Levers may move now.
  assert_true(deadman.step(true, false, Trouble::kNone));
  assert_false(release(deadman));
  assert_true(press(deadman));
}

TEST(held_from_the_start_it_does_not_count) {
  Deadman deadman;
  assert_false(press(deadman));
  assert_true(deadman.trouble() == Trouble::kStart);
  assert_false(press(deadman));
  assert_false(release(deadman));
  assert_true(deadman.trouble() == Trouble::kNone);
  assert_true(press(deadman));
}

TEST(pressed_with_a_lever_off_its_middle_it_does_not_count) {
  Deadman deadman;
  assert_false(release(deadman));
  assert_false(deadman.step(true, false, Trouble::kNone));
  assert_true(deadman.trouble() == Trouble::kNotAtRest);
  // Not even once the lever is back.
  assert_false(press(deadman));
  assert_false(release(deadman));
  assert_true(press(deadman));
}

TEST(trouble_ends_it_in_the_same_cycle) {
  for (const Trouble trouble : kTroubles) {
    Deadman deadman;
    assert_false(release(deadman));
    assert_true(press(deadman));
    assert_false(deadman.step(true, true, trouble));
    assert_true(deadman.trouble() == trouble);
    assert_true(trouble_words(trouble)[0] != '\0');
    // Over, and still held: no.
    assert_false(press(deadman));
    assert_false(release(deadman));
    assert_true(press(deadman));
  }
}

/// What is held while the device comes back was not seen to be pressed.
TEST(a_release_during_trouble_is_none) {
  for (const Trouble trouble : kTroubles) {
    Deadman deadman;
    assert_false(release(deadman));
    assert_false(deadman.step(false, true, trouble));
    assert_false(press(deadman));
    assert_false(release(deadman));
    assert_true(press(deadman));
  }
}
