// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Valves as they are sold, in the place of what takes our SpoolCommand.
///
///   auxiliary valves of ISO 11783-7, 0 to 2: port flow command, 0.4 %, and state command (PGN
///   65072
///     on); the flow is the spool's share of its travel
///   a driver of proportional solenoids, one message a spool: current of each side, mA, dither, Hz,
///     enable and a counter that goes on
///
/// Silent for `kTimeoutUs`, with a state or dither that there is none of, or with both sides
/// driven, a spool is let go. Once all were, each has to be told neutral before it moves again.

#include <array>
#include <cstddef>
#include <cstdint>

#include "app/plant/excavator_plant.hpp"
#include "firmware/core/time.hpp"
#include "hal/can_frame.hpp"

namespace graben::plant {

class SoldValves {
 public:
  static constexpr TimeUs kTimeoutUs = 100 * kMillisecondUs;
  static constexpr double kLeast_ma = 250.0;
  static constexpr double kMost_ma = 750.0;

  enum class Kind : std::uint8_t { kAuxiliary, kDriver };

  explicit SoldValves(Kind kind) : kind_(kind) {}

  void take(const CanFrame& frame, TimeUs now);
  /// Of all that has been taken; once a cycle.
  void decide(TimeUs now);
  /// Every spool is told what to do.
  [[nodiscard]] bool drives() const { return drives_; }
  [[nodiscard]] double duty(std::size_t axis) const { return valve_[axis].duty; }

 private:
  struct Valve {
    bool told = false;
    TimeUs told_us = 0;
    double duty = 0.0;
    bool counts = false;
    std::uint8_t counter = 0;
  };

  [[nodiscard]] static bool read_auxiliary(const CanFrame& frame, double& duty);
  [[nodiscard]] static bool read_driver(const CanFrame& frame, Valve& valve);

  Kind kind_;
  std::array<Valve, kAxisCount> valve_{};
  bool drives_ = false;
  bool needs_neutral_ = true;
};

}  // namespace graben::plant
