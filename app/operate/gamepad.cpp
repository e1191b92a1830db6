// SPDX-License-Identifier: Apache-2.0
#include "app/operate/gamepad.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/input.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "app/operate/gamepad_layout.hpp"
#include "platform/linux/process.hpp"

namespace graben::operate {
namespace {

constexpr TimeUs kReopen_us = 500 * kMillisecondUs;
/// Of one cycle: a device that floods cannot hold the station up.
constexpr int kMostEvents = 4096;

std::string reason_of(int error_number) {
  const char* const words = error_words(error_number);
  return error_number == EACCES ? fmt::format("{}: be in the group `input`, or root", words)
                                : words;
}

int open_device(const std::string& path) {
  return ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
}

}  // namespace

void Gamepad::Free::operator()(libevdev* device) const {
  const int fd = libevdev_get_fd(device);
  libevdev_free(device);
  ::close(fd);
}

GamepadSearch find_gamepads(const std::string& folder) {
  std::vector<std::string> paths;
  std::error_code no_folder;
  for (const auto& entry : std::filesystem::directory_iterator(folder, no_folder)) {
    if (entry.path().filename().string().rfind("event", 0) == 0) {
      paths.push_back(entry.path().string());
    }
  }
  std::sort(paths.begin(), paths.end());
  GamepadSearch search;
  for (const std::string& path : paths) {
    const int fd = open_device(path);
    libevdev* device = nullptr;
    if (fd < 0) {
      ++(errno == EACCES ? search.forbidden : search.others);
    } else if (libevdev_new_from_fd(fd, &device) == 0 && what_is_missing(device).empty()) {
      search.gamepads.push_back({path, libevdev_get_name(device)});
    } else {
      ++search.others;
    }
    libevdev_free(device);
    if (fd >= 0) {
      ::close(fd);
    }
  }
  return search;
}

std::string only_gamepad(const GamepadSearch& search) {
  if (search.gamepads.size() == 1) {
    return search.gamepads.front().path;
  }
  std::string what;
  if (search.gamepads.empty()) {
    what = fmt::format("no gamepad among {} input devices", search.others + search.forbidden);
    if (search.forbidden > 0) {
      what += fmt::format("; {} of them may not be read: be in the group `input`, or root",
                          search.forbidden);
    }
    throw std::runtime_error(what + ". Without one, in a simulation: --keyboard");
  }
  for (const GamepadSearch::Found& gamepad : search.gamepads) {
    what += fmt::format("\n  {}  {}", gamepad.path, gamepad.name);
  }
  throw std::runtime_error("more than one gamepad; choose by --gamepad:" + what);
}

Gamepad::Device Gamepad::open(const std::string& path) {
  const int fd = open_device(path);
  if (fd < 0) {
    throw std::runtime_error(fmt::format("{}: {}", path, reason_of(errno)));
  }
  libevdev* raw = nullptr;
  if (const int error = libevdev_new_from_fd(fd, &raw); error != 0) {
    ::close(fd);
    throw std::runtime_error(
        fmt::format("{}: no input device of the kernel: {}", path, error_words(-error)));
  }
  Device device(raw);
  if (const std::string missing = what_is_missing(raw); !missing.empty()) {
    throw std::runtime_error(
        fmt::format("{} ({}) is no gamepad: it has not {}", path, libevdev_get_name(raw), missing));
  }
  if (const int error = libevdev_grab(raw, LIBEVDEV_GRAB); error != 0) {
    throw std::runtime_error(
        fmt::format("{}: another program has it: {}", path, error_words(-error)));
  }
  return device;
}

Gamepad::Gamepad(std::string path)
    : path_(std::move(path)), device_(open(path_)), name_(libevdev_get_name(device_.get())) {}

Gamepad::~Gamepad() = default;

std::string Gamepad::help() const {
  return "Hold the left shoulder button: enable. Left stick: swing, arm. Right stick:\n"
         "boom, bucket. Start: mode. Select: task. D-pad up, down: speed. Right four\n"
         "buttons, teeth at: upper the mark, left the benchmark, right the heading's point,\n"
         "lower a made place, to check. Left stick pressed: tracks moved. Ctrl-C: end";
}

void Gamepad::reopen(TimeUs now) {
  if (now < next_try_us_) {
    return;
  }
  next_try_us_ = now + kReopen_us;
  try {
    device_ = open(path_);
    name_ = libevdev_get_name(device_.get());
    last_sign_us_ = now;
  } catch (const std::runtime_error&) {
    // Still away: tried again in a moment.
  }
}

bool Gamepad::take_events(Hands& presses, TimeUs now) {
  libevdev* const device = device_.get();
  for (int i = 0; i < kMostEvents; ++i) {
    input_event event{};
    int status = libevdev_next_event(device, LIBEVDEV_READ_FLAG_NORMAL, &event);
    if (status == LIBEVDEV_READ_STATUS_SYNC) {
      // The kernel's queue was full. The state is asked for again, and presses are not guessed.
      presses.lost_events = true;
      do {
        status = libevdev_next_event(device, LIBEVDEV_READ_FLAG_SYNC, &event);
      } while (status == LIBEVDEV_READ_STATUS_SYNC);
    } else if (status == LIBEVDEV_READ_STATUS_SUCCESS) {
      last_sign_us_ = now;
      note_press(event, presses);
    }
    if (status == -EAGAIN && !presses.lost_events) {
      return true;
    }
    if (status < 0 && status != -EAGAIN) {
      return false;
    }
    if (status == -EAGAIN && libevdev_has_event_pending(device) <= 0) {
      return true;
    }
  }
  // What floods is not understood.
  presses.lost_events = true;
  return true;
}

bool Gamepad::asks_deadman(bool& held) const {
  std::array<unsigned char, KEY_MAX / 8 + 1> keys{};
  if (::ioctl(libevdev_get_fd(device_.get()), EVIOCGKEY(keys.size()), keys.data()) < 0) {
    return false;
  }
  held = ((keys[kDeadmanButton / 8] >> (kDeadmanButton % 8)) & 1U) != 0;
  return true;
}

Hands Gamepad::read(TimeUs now) {
  if (!has_begun_) {
    has_begun_ = true;
    last_sign_us_ = now;
  }
  if (is_gone_) {
    is_gone_ = false;
    device_.reset();
  } else if (!device_) {
    reopen(now);
  }
  Hands presses;
  bool held = false;
  if (!device_ || !take_events(presses, now) || !asks_deadman(held)) {
    is_gone_ = device_ != nullptr;
    Hands gone;
    gone.is_there = false;
    return gone;
  }
  Hands hands = hands_of(device_.get());
  hands.deadman = hands.deadman && held;
  hands.quiet_us = now - last_sign_us_;
  hands.lost_events = presses.lost_events;
  hands.speed_steps = presses.speed_steps;
  hands.changes_mode = presses.changes_mode;
  hands.changes_task = presses.changes_task;
  hands.touches = presses.touches;
  return hands;
}

}  // namespace graben::operate
