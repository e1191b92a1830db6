// SPDX-License-Identifier: Apache-2.0
#pragma once
/// IMUs of a machine's links on a bus of SAE J1939 (j1939.dbc): which signal is in which frame.
///
/// Each is known by its source address, whatever its priority: angular rate (PGN 61482) and
/// acceleration (PGN 61485). Nothing in these frames tells a right one from a wrong one, so that
/// all that can be judged is judged:
///
///   kind, length                     the frame is refused
///   a value beyond its range         the frame is refused, its signal ages
///   figure of merit 'degraded'       the signal is kError, as for the value 'error'
///   faster than one in 8 ms          the frame is refused and its signal is kError: two senders
///
/// Age, rate of change and what gyro and gravity say of each other are for the core.

#include <array>
#include <cstdint>

#include "can_dbc/generated/j1939_dbc.hpp"
#include "firmware/excavator/excavator_signals.hpp"
#include "hal/can_frame.hpp"
#include "hal/link/message_links.hpp"
#include "hal/link/message_rules.hpp"
#include "hal/link/pace.hpp"

namespace graben {

class LinkImus {
 public:
  /// Frames each IMU sends.
  static constexpr int kMessagesEach = 2;

  /// `address` of each IMU; 0: there is none. The caller has seen to it that they differ.
  explicit LinkImus(const ImuAddresses& address) : address_(address) {
    for (const std::uint8_t each : address) {
      any_ = any_ || each != 0;
    }
  }

  /// True if the frame has an id of theirs: then it is nobody else's. Its values go to their place,
  /// unless it is refused.
  [[nodiscard]] bool take(const CanFrame& frame, TimeUs now, std::array<ImuInputs, kImuCount>& to) {
    return any_ && !frame.error && frame.extended && take_extended(frame, now, to);
  }

  [[nodiscard]] const LinkCounters& counters() const { return counters_; }

 private:
  [[nodiscard]] bool take_extended(const CanFrame& frame, TimeUs now,
                                   std::array<ImuInputs, kImuCount>& to);

  ImuAddresses address_;
  bool any_ = false;
  std::array<std::array<Pace, kMessagesEach>, kImuCount> pace_{};
  LinkCounters counters_;
};

/// The 29-bit ids of their frames, for a port's filters; 0 where there is no IMU.
[[nodiscard]] std::array<std::uint32_t, kImuCount * LinkImus::kMessagesEach> imu_ids(
    const ImuAddresses& address);

}  // namespace graben
