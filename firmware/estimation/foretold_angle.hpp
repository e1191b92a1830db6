// SPDX-License-Identifier: Apache-2.0
#pragma once
/// An angle that its sensor shows late, as of the time that it came: it goes on at its rate.

#include <array>

#include "firmware/core/time.hpp"
#include "firmware/estimation/tuning.hpp"
#include "firmware/signals/signal.hpp"

namespace graben {

/// What was shown before, newest first. As constructed nothing has been seen.
struct ForetoldAngle {
  struct Reading {
    bool known = false;
    double angle_rad = 0.0;
    TimeUs stamp_us = 0;
  };
  std::array<Reading, 1 + kForetoldReadings> reading{};
};

/// `shown`, `latency_s` after what it tells of, rad. As it is shown where it is not valid, and
/// until readings before it say how it moves.
[[nodiscard]] Signal<double> foretold(const Signal<double>& shown, double latency_s,
                                      ForetoldAngle& state);

}  // namespace graben
