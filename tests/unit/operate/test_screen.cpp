// SPDX-License-Identifier: Apache-2.0
/// What the operator reads.

#include "app/operate/screen.hpp"

#include <string>
#include <vector>

#include "app/operate/keyboard.hpp"
#include "app/runs/code_text.hpp"
#include "tests/unit/cmocka_cpp.hpp"

using dbc::RawState;
using operate::EcuListener;
using operate::Trouble;
using operate::View;
using Dbc = EcuListener::Dbc;

template <class Message>
void say(EcuListener& ecu, const Message& message) {
  CanFrame frame;
  frame.id = Message::kId;
  frame.length = Message::kLength;
  frame.data = message.encode();
  ecu.hear(frame, 0);
}

void say_status(EcuListener& ecu, EcuMode mode, Fault fault = Fault::kNone) {
  Dbc::EcuStatus status;
  status.mode = {static_cast<Dbc::EcuStatus::Mode>(mode), RawState::kValid};
  status.fault = {static_cast<Dbc::EcuStatus::Fault>(fault), RawState::kValid};
  status.lambda = {0.693, RawState::kValid};
  status.limit_kind = {Dbc::EcuStatus::LimitKind::kBackFlow, RawState::kValid};
  status.limit_index = {0, RawState::kValid};
  say(ecu, status);
}

View view_of(const EcuListener& ecu) {
  View view;
  view.interface = "can0";
  view.bus = CanPortState::kActive;
  view.hands = "Some Pad";
  view.help = operate::keyboard_help();
  view.ecu = &ecu;
  return view;
}

std::string text_of(const View& view) {
  std::string text;
  for (const std::string& line : operate::screen_lines(view)) {
    assert_true(line.size() <= operate::kColumns);
    text += line + "\n";
  }
  return text;
}

void check_has(const std::string& text, const std::string& part) {
  if (text.find(part) == std::string::npos) {
    fail_msg("'%s' is not in:\n%s", part.c_str(), text.c_str());
  }
}

TEST(without_a_controller_it_says_so) {
  const EcuListener ecu;
  View view = view_of(ecu);
  view.trouble = Trouble::kEcuSilent;
  check_has(text_of(view), "not heard; status never, health never");
  check_has(text_of(view), "released; the controller is not heard");
  check_has(text_of(view), "boom not heard");
  check_has(operate::state_line(view), "can0 active; controller not heard; Jog, Manual, speed 0 %");
}

TEST(lambda_is_a_bar_with_what_holds_it) {
  assert_string_equal(operate::bar(0.0).c_str(), "[....................]");
  assert_string_equal(operate::bar(0.5).c_str(), "[##########..........]");
  assert_string_equal(operate::bar(1.0).c_str(), "[####################]");
  assert_string_equal(operate::bar(7.0).c_str(), "[####################]");
  EcuListener ecu;
  say_status(ecu, EcuMode::kActive);
  View view = view_of(ecu);
  view.request.enable = true;
  view.deadman_held = true;
  check_has(text_of(view), "[##############......] 0.693, held by back flow: boom");
  check_has(text_of(view), "Active");
  check_has(text_of(view), "HELD: enable is given");
  assert_true(text_of(view).find("Not armed") == std::string::npos);
}

TEST(each_reason_for_not_arming_is_in_words) {
  EcuListener ecu;
  say_status(ecu, EcuMode::kReady);
  Dbc::EcuHealth health;
  health.why_not_armed = {(1U << 0U) | (1U << 11U), RawState::kValid};
  say(ecu, health);
  const View view = view_of(ecu);
  check_has(text_of(view), "Ready");
  check_has(operate::state_line(view), runs::arm_block_words(ArmBlock::kStroke));
  check_has(operate::state_line(view), runs::arm_block_words(ArmBlock::kManual));
  // All of them at once still fit.
  health.why_not_armed = {0xFFFFFFFFU, RawState::kValid};
  say(ecu, health);
  check_has(text_of(view), "Not armed");
}

TEST(every_fault_fits_with_what_to_do) {
  for (int number = 1; number < kFaultCount; ++number) {
    EcuListener ecu;
    const auto fault = static_cast<Fault>(number);
    say_status(ecu, EcuMode::kFault, fault);
    const std::string text = text_of(view_of(ecu));
    check_has(text, std::string(runs::fault_help(fault)).substr(0, 8));
    check_has(text, std::string(runs::pilot_words(fault)).substr(0, 18));
    check_has(operate::state_line(view_of(ecu)), runs::fault_words(fault));
  }
}

TEST(a_deadman_that_does_not_count_says_why) {
  const EcuListener ecu;
  View view = view_of(ecu);
  view.deadman_held = true;
  view.trouble = Trouble::kDeviceSilent;
  check_has(operate::state_line(view),
            "held, and does not count: the gamepad has been silent for too long; release it");
}

TEST(another_version_is_said) {
  EcuListener ecu;
  Dbc::EcuIdentity identity;
  identity.dbc_version = {3, RawState::kValid};
  say(ecu, identity);
  check_has(text_of(view_of(ecu)), "the controller's frames are version 3, this station's ");
  check_has(operate::state_line(view_of(ecu)), "version 3");
}

TEST(axes_have_the_tasks_names) {
  const EcuListener ecu;
  View view = view_of(ecu);
  view.request.axes = {0.5, -0.25, 0.0, 1.0};
  check_has(text_of(view), "boom +50 %, arm -25 %, bucket +0 %, swing +100 %");
  view.chosen_task = Task::kAssist;
  check_has(text_of(view), "boom +50 %, arm -25 %, bucket +0 %, swing +100 %");
  view.chosen_task = Task::kCoordinated;
  check_has(text_of(view), "up +50 %, forward -25 %, attitude +0 %, swing +100 %");
}

TEST(the_last_check_at_the_mark_is_shown) {
  using Checks = Dbc::EcuChecks;
  EcuListener ecu;
  say_status(ecu, EcuMode::kReady);
  Checks checks;
  say(ecu, checks);
  assert_true(text_of(view_of(ecu)).find("Mark ") == std::string::npos);
  checks.result = {Checks::Result::kNever, RawState::kValid};
  const struct {
    Checks::Touch touch;
    const char* words;
  } refusals[] = {{Checks::Touch::kMoving, "the teeth were"},
                  {Checks::Touch::kNotByHand, "choose Manual"},
                  {Checks::Touch::kNotKnown, "where the teeth"}};
  for (const auto& [touch, words] : refusals) {
    checks.touch = {touch, RawState::kValid};
    say(ecu, checks);
    check_has(text_of(view_of(ecu)), "not checked since the start");
    check_has(text_of(view_of(ecu)), words);
  }
  checks.result = {Checks::Result::kPassed, RawState::kValid};
  checks.touch = {Checks::Touch::kTaken, RawState::kValid};
  checks.age_s = {720.0, RawState::kValid};
  checks.off_outwards_m = {0.004, RawState::kValid};
  checks.off_across_m = {-0.002, RawState::kValid};
  checks.off_up_m = {0.012, RawState::kValid};
  say(ecu, checks);
  check_has(text_of(view_of(ecu)), "checked 12 min ago: +4 mm outwards, -2 across, +12 up");
  checks.result = {Checks::Result::kMissed, RawState::kValid};
  say(ecu, checks);
  check_has(text_of(view_of(ecu)), "MISSED 12 min ago");
}
