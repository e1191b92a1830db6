// SPDX-License-Identifier: Apache-2.0
/// What is said where there is no gamepad, or more than one.

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "app/operate/gamepad.hpp"
#include "tests/unit/cmocka_cpp.hpp"

using operate::find_gamepads;
using operate::Gamepad;
using operate::GamepadSearch;
using operate::only_gamepad;

std::string refusal(const GamepadSearch& search) {
  try {
    return "took " + only_gamepad(search);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

std::string refusal(const std::string& path) {
  try {
    const Gamepad gamepad(path);
    return "took " + gamepad.name();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

void check_has(const std::string& text, const char* part) {
  if (text.find(part) == std::string::npos) {
    fail_msg("'%s' is not in: %s", part, text.c_str());
  }
}

TEST(the_only_one_is_taken) {
  GamepadSearch search;
  search.gamepads = {{"/dev/input/event7", "Pad"}};
  search.others = 3;
  assert_string_equal(only_gamepad(search).c_str(), "/dev/input/event7");
}

TEST(none_is_said_with_what_there_is) {
  GamepadSearch search;
  search.others = 3;
  check_has(refusal(search), "no gamepad among 3 input devices");
  assert_true(refusal(search).find("may not be read") == std::string::npos);
  search.forbidden = 2;
  check_has(refusal(search), "no gamepad among 5 input devices; 2 of them may not be read");
  check_has(refusal(search), "group `input`");
}

TEST(several_are_named) {
  GamepadSearch search;
  search.gamepads = {{"/dev/input/event7", "Pad"}, {"/dev/input/event9", "Other"}};
  check_has(refusal(search), "more than one gamepad");
  check_has(refusal(search), "/dev/input/event7  Pad");
  check_has(refusal(search), "/dev/input/event9  Other");
}

TEST(a_folder_without_devices_has_none) {
  assert_int_equal(find_gamepads("/nowhere").others, 0);
  const auto folder = std::filesystem::temp_directory_path() / "graben_unit_operate_search";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "event0") << "no device";
  std::ofstream(folder / "mice") << "no event device either";
  const GamepadSearch search = find_gamepads(folder.string());
  assert_true(search.gamepads.empty());
  assert_int_equal(search.others, 1);
  check_has(refusal((folder / "event0").string()), "no input device of the kernel");
  std::filesystem::remove_all(folder);
}

TEST(a_path_without_a_device_is_refused) {
  check_has(refusal("/nowhere/event3"), "/nowhere/event3: No such file");
  check_has(refusal("/dev/null"), "/dev/null: no input device of the kernel");
}
