// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A station's bus, and what is known of the other end.

#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/ecu/last_frames.hpp"
#include "app/operate/deadman.hpp"
#include "app/operate/ecu_listener.hpp"
#include "app/operate/hands.hpp"
#include "platform/linux/socketcan_port.hpp"

namespace graben::operate {

/// The gamepad at this path, the only one there is if it is empty, or the keyboard. Throws
/// std::runtime_error as Gamepad and Keyboard.
[[nodiscard]] std::unique_ptr<HandSource> hands_for(const std::string& gamepad, bool keyboard);

class BusLink {
 public:
  /// All that is on the bus, what is sent from here too, in the order of its stamps.
  using Tap = std::function<void(const CanFrame&)>;

  /// Throws std::runtime_error, with the reason, if there is no such interface or it is down.
  explicit BusLink(std::string interface,
                   std::uint32_t dbc_version = EcuListener::Dbc::kDbcVersion);

  void set_tap(Tap tap) { tap_ = std::move(tap); }

  /// Once a cycle: everything that has come.
  void hear(TimeUs now);
  /// `last` is what has to be sent if the process dies before the next call.
  template <class Frames, class LastFrames>
  void send(const Frames& frames, const LastFrames& last) {
    last_.put(last);
    for (const CanFrame& frame : frames) {
      send_one(frame);
    }
  }
  /// Once a cycle: tries to open an interface that is down or a bus that does not come back, now
  /// and then.
  void mend(TimeUs now);
  /// Throws std::runtime_error if another station has sent.
  void refuse_other_station() const;

  [[nodiscard]] Trouble trouble(TimeUs now) const;
  [[nodiscard]] const EcuListener& ecu() const { return ecu_; }
  [[nodiscard]] CanPortState state() const { return ports_.front().state(); }
  [[nodiscard]] const ecu::LastFrames& last_frames() const { return last_; }
  [[nodiscard]] const std::deque<SocketCanPort>& ports() const { return ports_; }

 private:
  SocketCanPort& port() { return ports_.front(); }
  void send_one(const CanFrame& frame);
  void tell_tap();

  std::string interface_;
  std::deque<SocketCanPort> ports_;
  EcuListener ecu_;
  ecu::LastFrames last_;
  TimeUs next_try_us_ = 0;
  Tap tap_;
  std::vector<CanFrame> untold_;  ///< To the tap.
};

}  // namespace graben::operate
