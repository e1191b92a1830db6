// SPDX-License-Identifier: Apache-2.0
#include "app/operate/bus_link.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "app/operate/gamepad.hpp"
#include "app/operate/terminal.hpp"
#include "platform/linux/cyclic_clock.hpp"

namespace graben::operate {
namespace {

constexpr TimeUs kReopenBus_us = 500 * kMillisecondUs;
/// Of one cycle; what a bus can carry in a second.
constexpr int kMostReads = 128;

}  // namespace

std::unique_ptr<HandSource> hands_for(const std::string& gamepad, bool keyboard) {
  if (keyboard) {
    return std::make_unique<Keyboard>();
  }
  return std::make_unique<Gamepad>(gamepad.empty() ? only_gamepad(find_gamepads()) : gamepad);
}

BusLink::BusLink(std::string interface, std::uint32_t dbc_version)
    : interface_(std::move(interface)), ecu_(dbc_version) {
  ports_.emplace_back(interface_, std::vector<std::uint32_t>{});
  if (!port().open()) {
    throw std::runtime_error(port().last_error());
  }
}

void BusLink::hear(TimeUs now) {
  constexpr int kFramesPerRead = 64;
  std::array<CanFrame, kFramesPerRead> frames;
  int count = kFramesPerRead;
  for (int read = 0; read < kMostReads && count == kFramesPerRead; ++read) {
    count = port().receive(frames.data(), kFramesPerRead);
    for (int i = 0; i < count; ++i) {
      const CanFrame& frame = frames[static_cast<std::size_t>(i)];
      ecu_.hear(frame, now);
      if (tap_) {
        untold_.push_back(frame);
      }
    }
  }
  tell_tap();
}

/// What was sent in the last cycle lies among what has come since.
void BusLink::tell_tap() {
  std::stable_sort(untold_.begin(), untold_.end(), [](const CanFrame& one, const CanFrame& other) {
    return one.stamp_us < other.stamp_us;
  });
  for (const CanFrame& frame : untold_) {
    tap_(frame);
  }
  untold_.clear();
}

void BusLink::send_one(const CanFrame& frame) {
  // What is not taken is not sent again: the next one comes soon, and says more.
  if (port().send(frame) && tap_) {
    untold_.push_back(frame);
    untold_.back().stamp_us = monotonic_now_us();
  }
}

void BusLink::mend(TimeUs now) {
  if (now >= next_try_us_ && state() != CanPortState::kActive) {
    next_try_us_ = now + kReopenBus_us;
    // Still away: tried again in a moment.
    static_cast<void>(port().open());
  }
}

Trouble BusLink::trouble(TimeUs now) const {
  if (state() != CanPortState::kActive) {
    return Trouble::kBus;
  }
  if (!ecu_.hears_ecu(now)) {
    return Trouble::kEcuSilent;
  }
  return ecu_.other_version() ? Trouble::kOtherDbc : Trouble::kNone;
}

void BusLink::refuse_other_station() const {
  if (const auto other = ecu_.other_station()) {
    throw std::runtime_error(
        fmt::format("{}: another station sends OperatorCommand (source address {}); two at a time "
                    "are none. Nothing more is sent from here",
                    interface_, *other));
  }
}

}  // namespace graben::operate
