// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The operator's hands, whatever they hold.

#include <optional>
#include <string>

#include "app/operate/levers.hpp"
#include "firmware/core/time.hpp"
#include "firmware/signals/machine_signals.hpp"

namespace graben::operate {

/// What the hands do in a cycle of the station.
struct Hands {
  bool is_there = true;      ///< What they hold is there; else all the rest is nothing.
  bool lost_events = false;  ///< Something of what they did is not known.
  bool deadman = false;      ///< Held.
  Levers levers;
  TimeUs quiet_us = 0;  ///< Since the last sign of life of what they hold.
  // Presses since the cycle before.
  int speed_steps = 0;  ///< Faster is positive.
  bool changes_mode = false;
  bool changes_task = false;
  std::optional<TouchKind> touches;  ///< What the tool is at, or that the tracks have moved.
  bool quits = false;
};

/// A gamepad, or a keyboard.
class HandSource {
 public:
  HandSource() = default;
  HandSource(const HandSource&) = delete;
  HandSource& operator=(const HandSource&) = delete;
  virtual ~HandSource() = default;

  /// Once a cycle. Never waits.
  [[nodiscard]] virtual Hands read(TimeUs now) = 0;
  [[nodiscard]] virtual std::string name() const = 0;
  /// What to press, for the screen; each line of at most 80 characters.
  [[nodiscard]] virtual std::string help() const = 0;
};

}  // namespace graben::operate
