// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A terminal's keyboard in place of a gamepad: for simulations and tests, not for a machine.
///
/// A terminal tells no release of a key; it only repeats the key that was pressed last. So a key
/// counts as held for a time after it has come, and one key after the other is the deadman: space,
/// or the key of the lever that it is to move. Let go, the last of them acts for up to
/// kRepeat_us more, and a key that was only tapped for kFirst_us.

#include <string>
#include <string_view>

#include "app/operate/hands.hpp"

namespace graben::operate {

/// From bytes of the terminal to hands.
class KeyHold {
 public:
  /// After a key comes for the first time: repeating begins after 250 to 660 ms, as terminals are
  /// set.
  static constexpr TimeUs kFirst_us = 700 * kMillisecondUs;
  /// After it has come again: 11 to 40 times a second.
  static constexpr TimeUs kRepeat_us = 150 * kMillisecondUs;

  /// Once a cycle, with what has come since the last one.
  [[nodiscard]] Hands step(std::string_view bytes, TimeUs now);

 private:
  void press(char key, Hands& presses, TimeUs now);

  char held_ = '\0';  ///< The key that was pressed last.
  TimeUs until_us_ = 0;
};

/// What to press; lines of at most 80 characters.
[[nodiscard]] const char* keyboard_help();

}  // namespace graben::operate
