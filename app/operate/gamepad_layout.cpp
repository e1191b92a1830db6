// SPDX-License-Identifier: Apache-2.0
#include "app/operate/gamepad_layout.hpp"

#include <array>

namespace graben::operate {
namespace {

struct StickCodes {
  unsigned across = 0;
  unsigned down = 0;
};

constexpr StickCodes kLeftStick = {ABS_X, ABS_Y};
constexpr StickCodes kRightStick = {ABS_RX, ABS_RY};
/// Where pads have it that call their triggers nothing.
constexpr StickCodes kOtherRightStick = {ABS_Z, ABS_RZ};

bool has_axis(const libevdev* device, unsigned code) {
  return libevdev_has_event_code(device, EV_ABS, code) != 0 &&
         libevdev_get_abs_maximum(device, code) > libevdev_get_abs_minimum(device, code);
}

bool has_stick(const libevdev* device, const StickCodes& codes) {
  return has_axis(device, codes.across) && has_axis(device, codes.down);
}

double axis_ratio(const libevdev* device, unsigned code) {
  const StickRange range = {libevdev_get_abs_minimum(device, code),
                            libevdev_get_abs_maximum(device, code),
                            libevdev_get_abs_flat(device, code)};
  return stick_ratio(libevdev_get_event_value(device, EV_ABS, code), range);
}

/// Away from the operator is up, where a stick's values are least.
Lever lever_of(const libevdev* device, const StickCodes& codes) {
  const double down = axis_ratio(device, codes.down);
  return {axis_ratio(device, codes.across), down == 0.0 ? 0.0 : -down};
}

}  // namespace

std::string what_is_missing(const libevdev* device) {
  struct Button {
    unsigned code;
    const char* name;
  };
  constexpr std::array<Button, 4> kButtons = {{{BTN_GAMEPAD, "the buttons of a gamepad"},
                                               {kDeadmanButton, "the left shoulder button"},
                                               {kModeButton, "a start button"},
                                               {kTaskButton, "a select button"}}};
  for (const Button& button : kButtons) {
    if (libevdev_has_event_code(device, EV_KEY, button.code) == 0) {
      return button.name;
    }
  }
  if (!has_stick(device, kLeftStick)) {
    return "a left stick";
  }
  const bool has_right = has_stick(device, kRightStick) || has_stick(device, kOtherRightStick);
  return has_right ? "" : "a right stick";
}

Hands hands_of(const libevdev* device) {
  Hands hands;
  hands.deadman = libevdev_get_event_value(device, EV_KEY, kDeadmanButton) != 0;
  hands.levers.left = lever_of(device, kLeftStick);
  hands.levers.right =
      lever_of(device, has_stick(device, kRightStick) ? kRightStick : kOtherRightStick);
  return hands;
}

namespace {

std::optional<TouchKind> touch_of(unsigned button) {
  switch (button) {
    case kMarkButton:
      return TouchKind::kMark;
    case kBenchmarkButton:
      return TouchKind::kBenchmark;
    case kHeadingButton:
      return TouchKind::kHeading;
    case kSurfaceButton:
      return TouchKind::kSurface;
    case kMovedButton:
      return TouchKind::kMoved;
    default:
      return std::nullopt;
  }
}

}  // namespace

void note_press(const input_event& event, Hands& hands) {
  const bool is_button = event.type == EV_KEY && event.value == 1;
  if (is_button && event.code == kModeButton) {
    hands.changes_mode = !hands.changes_mode;
  } else if (is_button && event.code == kTaskButton) {
    hands.changes_task = !hands.changes_task;
  } else if (is_button && touch_of(event.code)) {
    hands.touches = touch_of(event.code);
  } else if (is_button && event.code == BTN_DPAD_UP) {
    ++hands.speed_steps;
  } else if (is_button && event.code == BTN_DPAD_DOWN) {
    --hands.speed_steps;
  } else if (event.type == EV_ABS && event.code == ABS_HAT0Y) {
    hands.speed_steps -= event.value > 0 ? 1 : event.value < 0 ? -1 : 0;
  }
}

}  // namespace graben::operate
