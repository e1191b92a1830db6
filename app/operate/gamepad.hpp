// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A gamepad through libevdev.
///
/// The kernel tells changes only: a button that is held says nothing. What a gamepad's end looks
/// like: unplugged, or a wireless one that its driver gives up, is an error of the next read, or
/// of the question for the buttons' state that is asked in every cycle. One that has fallen silent
/// behind a receiver that stays keeps its last state for ever: only time tells, see
/// StationOptions::silent_after_us.

#include <libevdev/libevdev.h>

#include <memory>
#include <string>
#include <vector>

#include "app/operate/hands.hpp"

namespace graben::operate {

/// What is in a folder of input devices.
struct GamepadSearch {
  struct Found {
    std::string path;
    std::string name;
  };
  std::vector<Found> gamepads;
  int others = 0;     ///< Devices that are no gamepad.
  int forbidden = 0;  ///< Devices that this user may not read.
};

inline constexpr const char* kInputFolder = "/dev/input";

[[nodiscard]] GamepadSearch find_gamepads(const std::string& folder = kInputFolder);

/// The path of the only gamepad there is. Throws std::runtime_error, with what there is and what to
/// do, if there is none or more than one.
[[nodiscard]] std::string only_gamepad(const GamepadSearch& search);

class Gamepad final : public HandSource {
 public:
  /// Takes the device for itself: nobody else hears it meanwhile. Throws std::runtime_error, with
  /// the reason, if there is none at this path, or if it is no gamepad.
  explicit Gamepad(std::string path);
  ~Gamepad() override;

  /// One that is gone is looked for again at the same path, twice a second.
  [[nodiscard]] Hands read(TimeUs now) override;
  [[nodiscard]] std::string name() const override { return name_; }
  [[nodiscard]] std::string help() const override;

 private:
  struct Free {
    void operator()(libevdev* device) const;
  };
  using Device = std::unique_ptr<libevdev, Free>;

  static Device open(const std::string& path);
  void reopen(TimeUs now);
  /// Takes all events that are there; false if the device is gone.
  bool take_events(Hands& presses, TimeUs now);
  /// The kernel's own word on the button; false if it cannot say.
  [[nodiscard]] bool asks_deadman(bool& held) const;

  std::string path_;
  Device device_;
  std::string name_;
  TimeUs last_sign_us_ = 0;
  bool has_begun_ = false;
  /// Closed in the next cycle: that takes the kernel longer than a cycle, and enable has to go
  /// first.
  bool is_gone_ = false;
  TimeUs next_try_us_ = 0;
};

}  // namespace graben::operate
