// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Which stick and button of a gamepad does what. The kernel gives all gamepads the same codes
/// (its Documentation/input/gamepad.rst); some older ones have their right stick elsewhere.

#include <libevdev/libevdev.h>

#include <string>

#include "app/operate/hands.hpp"

namespace graben::operate {

/// Of the two left shoulder buttons the upper one: a finger holds it while the thumb steers.
inline constexpr unsigned kDeadmanButton = BTN_TL;
inline constexpr unsigned kModeButton = BTN_START;
inline constexpr unsigned kTaskButton = BTN_SELECT;
inline constexpr unsigned kMarkButton = BTN_NORTH;
inline constexpr unsigned kBenchmarkButton = BTN_WEST;
inline constexpr unsigned kHeadingButton = BTN_EAST;
inline constexpr unsigned kSurfaceButton = BTN_SOUTH;
inline constexpr unsigned kMovedButton = BTN_THUMBL;

/// Empty if the station can work with the device; else what it lacks.
[[nodiscard]] std::string what_is_missing(const libevdev* device);

/// Levers and deadman, from the device's state as libevdev has it; nothing of presses. The left
/// stick is the left lever, the right stick the right one.
[[nodiscard]] Hands hands_of(const libevdev* device);

/// Adds what an event presses: mode, task, touches, and with the d-pad's up and down the speed.
void note_press(const input_event& event, Hands& hands);

}  // namespace graben::operate
