// SPDX-License-Identifier: Apache-2.0
/// What the station makes of a gamepad's codes. libevdev keeps the state of a device without one.

#include "app/operate/gamepad_layout.hpp"

#include <cstring>
#include <memory>
#include <string>

#include "tests/unit/cmocka_cpp.hpp"

using operate::Hands;
using operate::hands_of;
using operate::note_press;
using operate::what_is_missing;

/// A pad as most drivers describe it; its right stick where it is told.
struct Pad {
  explicit Pad(unsigned right_across = ABS_RX, unsigned right_down = ABS_RY) {
    for (const unsigned code : {BTN_SOUTH, BTN_TL, BTN_START, BTN_SELECT}) {
      libevdev_enable_event_code(device.get(), EV_KEY, code, nullptr);
    }
    for (const unsigned code : {unsigned{ABS_X}, unsigned{ABS_Y}, right_across, right_down}) {
      add_axis(code);
    }
  }
  void add_axis(unsigned code) {
    input_absinfo range{};
    range.minimum = -100;
    range.maximum = 100;
    libevdev_enable_event_code(device.get(), EV_ABS, code, &range);
  }
  void remove(unsigned type, unsigned code) {
    libevdev_disable_event_code(device.get(), type, code);
  }
  void put(unsigned type, unsigned code, int value) {
    assert_int_equal(libevdev_set_event_value(device.get(), type, code, value), 0);
  }

  std::unique_ptr<libevdev, void (*)(libevdev*)> device{libevdev_new(), libevdev_free};
};

TEST(a_pad_is_a_pad) {
  assert_string_equal(what_is_missing(Pad().device.get()).c_str(), "");
  assert_string_equal(what_is_missing(Pad(ABS_Z, ABS_RZ).device.get()).c_str(), "");
}

void check_missing(unsigned type, unsigned code, const char* part) {
  Pad pad;
  pad.remove(type, code);
  const std::string missing = what_is_missing(pad.device.get());
  assert_non_null(std::strstr(missing.c_str(), part));
}

TEST(what_lacks_something_is_none) {
  check_missing(EV_KEY, BTN_SOUTH, "buttons of a gamepad");
  check_missing(EV_KEY, BTN_TL, "left shoulder");
  check_missing(EV_KEY, BTN_START, "start");
  check_missing(EV_KEY, BTN_SELECT, "select");
  check_missing(EV_ABS, ABS_X, "left stick");
  check_missing(EV_ABS, ABS_Y, "left stick");
  check_missing(EV_ABS, ABS_RX, "right stick");
  check_missing(EV_ABS, ABS_RY, "right stick");
}

TEST(an_axis_without_travel_is_none) {
  Pad pad;
  libevdev_set_abs_minimum(pad.device.get(), ABS_Y, 100);
  assert_string_equal(what_is_missing(pad.device.get()).c_str(), "a left stick");
}

TEST(sticks_are_levers) {
  Pad pad;
  pad.put(EV_ABS, ABS_X, 100);
  pad.put(EV_ABS, ABS_RY, 100);
  Hands hands = hands_of(pad.device.get());
  assert_near(hands.levers.left.right_ratio, 1.0, 0.0);
  assert_near(hands.levers.left.away_ratio, 0.0, 0.0);
  // Down is to the operator.
  assert_near(hands.levers.right.away_ratio, -1.0, 0.0);
  assert_near(hands.levers.right.right_ratio, 0.0, 0.0);
  pad.put(EV_ABS, ABS_X, 0);
  pad.put(EV_ABS, ABS_RY, 0);
  pad.put(EV_ABS, ABS_Y, -100);
  pad.put(EV_ABS, ABS_RX, -100);
  hands = hands_of(pad.device.get());
  assert_near(hands.levers.left.away_ratio, 1.0, 0.0);
  assert_near(hands.levers.right.right_ratio, -1.0, 0.0);
}

TEST(an_older_pads_right_stick_is_found) {
  Pad pad(ABS_Z, ABS_RZ);
  pad.put(EV_ABS, ABS_Z, 100);
  pad.put(EV_ABS, ABS_RZ, -100);
  const Hands hands = hands_of(pad.device.get());
  assert_near(hands.levers.right.right_ratio, 1.0, 0.0);
  assert_near(hands.levers.right.away_ratio, 1.0, 0.0);
}

/// Where both are, the other one is a pair of triggers.
TEST(triggers_are_no_stick) {
  Pad pad;
  pad.add_axis(ABS_Z);
  pad.add_axis(ABS_RZ);
  pad.put(EV_ABS, ABS_Z, 100);
  pad.put(EV_ABS, ABS_RZ, 100);
  assert_true(hands_of(pad.device.get()).levers.are_at_rest());
}

TEST(the_deadman_is_the_left_shoulder) {
  Pad pad;
  assert_false(hands_of(pad.device.get()).deadman);
  pad.put(EV_KEY, BTN_SOUTH, 1);
  assert_false(hands_of(pad.device.get()).deadman);
  pad.put(EV_KEY, BTN_TL, 1);
  assert_true(hands_of(pad.device.get()).deadman);
}

Hands pressed(std::uint16_t type, std::uint16_t code, int value) {
  Hands hands;
  input_event event{};
  event.type = type;
  event.code = code;
  event.value = value;
  note_press(event, hands);
  return hands;
}

TEST(presses_count_once) {
  assert_true(pressed(EV_KEY, BTN_START, 1).changes_mode);
  assert_false(pressed(EV_KEY, BTN_START, 0).changes_mode);
  // A repetition is none.
  assert_false(pressed(EV_KEY, BTN_START, 2).changes_mode);
  assert_true(pressed(EV_KEY, BTN_SELECT, 1).changes_task);
  assert_false(pressed(EV_KEY, BTN_SELECT, 1).changes_mode);
  assert_int_equal(pressed(EV_KEY, BTN_DPAD_UP, 1).speed_steps, 1);
  assert_int_equal(pressed(EV_KEY, BTN_DPAD_DOWN, 1).speed_steps, -1);
  assert_int_equal(pressed(EV_ABS, ABS_HAT0Y, -1).speed_steps, 1);
  assert_int_equal(pressed(EV_ABS, ABS_HAT0Y, 1).speed_steps, -1);
  assert_int_equal(pressed(EV_ABS, ABS_HAT0Y, 0).speed_steps, 0);
  assert_int_equal(pressed(EV_ABS, ABS_HAT0X, 1).speed_steps, 0);
}
