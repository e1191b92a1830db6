// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the station shows: lines of at most 80 characters.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/operate/ecu_listener.hpp"
#include "app/operate/station.hpp"
#include "hal/can_port.hpp"

namespace graben::operate {

inline constexpr std::size_t kColumns = 80;

/// All that is shown, at a time.
struct View {
  std::string interface;
  CanPortState bus = CanPortState::kClosed;
  std::string hands;  ///< Name of the gamepad, or "keyboard".
  std::string help;
  bool deadman_held = false;
  Trouble trouble = Trouble::kNone;
  Task chosen_task = Task::kJog;
  Request request;
  const EcuListener* ecu = nullptr;
  TimeUs now_us = 0;
  TimeUs running_us = 0;
};

/// "Silent", "Ready", ...; "not heard" for none.
[[nodiscard]] const char* mode_words(std::optional<EcuMode> mode);
[[nodiscard]] const char* task_words(Task task);
/// Why the controller has not armed, as it says; empty if nothing keeps it.
[[nodiscard]] std::string not_armed_words(const EcuListener& ecu);

/// Share 0 .. 1 as a bar: "[#####...............]".
[[nodiscard]] std::string bar(double share);

/// The whole screen.
[[nodiscard]] std::vector<std::string> screen_lines(const View& view);

/// What is told where there is no screen to redraw: it changes seldom.
[[nodiscard]] std::string state_line(const View& view);

}  // namespace graben::operate
