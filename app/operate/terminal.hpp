// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The terminal: keys one by one, and a screen that is redrawn in its place. Nothing here waits.

#include <string>
#include <string_view>
#include <vector>

#include "app/operate/hands.hpp"
#include "app/operate/keyboard.hpp"

namespace graben::operate {

/// Standard input without lines and echo, as long as this lives. The terminal is given back as it
/// was when this ends, and before any signal that ends the process does its work: handlers that
/// are there when this is made are called after. Keys that stop the process or its output do
/// nothing meanwhile. One at a time.
class RawTerminal {
 public:
  /// Throws std::runtime_error if standard input is no terminal.
  RawTerminal();
  ~RawTerminal();
  RawTerminal(const RawTerminal&) = delete;
  RawTerminal& operator=(const RawTerminal&) = delete;

  /// What was typed since the last call; false at the end of the terminal.
  [[nodiscard]] bool read(std::string& bytes);
};

/// The keyboard as hands.
class Keyboard final : public HandSource {
 public:
  [[nodiscard]] Hands read(TimeUs now) override;
  [[nodiscard]] std::string name() const override { return "keyboard, for simulation and tests"; }
  [[nodiscard]] std::string help() const override { return keyboard_help(); }

 private:
  RawTerminal terminal_;
  KeyHold keys_;
};

/// Standard output. What it does not take at once is not shown.
class Display {
 public:
  Display();

  [[nodiscard]] bool is_terminal() const { return is_terminal_; }
  /// On a terminal: in the place of what was drawn last.
  void draw(const std::vector<std::string>& lines);
  /// A line, if it is another one than the last.
  void tell(double at_s, const std::string& line);

 private:
  bool is_terminal_;
  std::size_t drawn_lines_ = 0;
  std::string told_;
};

}  // namespace graben::operate
