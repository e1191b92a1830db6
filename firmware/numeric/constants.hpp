// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Constants of the controller and its tools; the simulated machine has its own.

#include <limits>

namespace graben {

/// Circumference of a circle over its diameter. [-; standard: geometry]
inline constexpr double kPi = 3.14159265358979323846;
/// Radians of a full turn. [rad; derived: kPi]
inline constexpr double kTwoPi = 2.0 * kPi;
/// Degrees of a radian. [-; derived: kPi]
inline constexpr double kDegreesPerRad = 180.0 / kPi;
/// Standard acceleration of free fall. [m/s2; standard: 3rd General Conference on Weights and
/// Measures, 1901]
inline constexpr double kStandardGravity_mps2 = 9.80665;
/// Positive infinity, for what has no bound. [-; standard: IEEE 754]
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace graben
