// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What of an excavator's section [control] follows from how late its drives answer: for a tool
/// that has found that out and writes the profile.

#include "firmware/excavator/excavator_profile.hpp"

namespace graben::machines {

/// Of the lowest mode: the servo's low-pass lies a little below it, see control.servo_frequency.
inline constexpr double kBelowMode = 0.87;

/// How the field converges, the servo around the valve's model (firmware/drives/drive_servo.hpp)
/// and the load's low-pass.
struct TunedControl {
  double convergence_length_m = 0.0;
  double servo_gain_ps = 0.0;
  double servo_frequency_hz = 0.0;
  double servo_damping = 0.0;
  double pressure_filter_s = 0.0;
};

/// Dead time and lag together of the latest side of boom, arm and bucket, s.
[[nodiscard]] double latest_answer_s(const ExcavatorProfile& profile);

/// Values with which a machine does not ring whose drives answer `late_s` after a command and whose
/// linkage has its lowest mode on the oil at `lowest_mode_hz`, where the teeth go at `speed_mps`;
/// all more than 0.
///
/// A correction that comes within a quarter of the mode's period takes energy out of it; one that
/// comes later feeds it, and then has to be small and well damped there. An integrator whose
/// answer, low-pass included, is late by T has a phase margin of 61 deg at a gain of 1 / (2 T). How
/// fast the field leads back is feedback too, by its speed over its length.
[[nodiscard]] TunedControl tuned_control(double late_s, double lowest_mode_hz, double speed_mps);

}  // namespace graben::machines
