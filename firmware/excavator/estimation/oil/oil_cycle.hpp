// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a mode on its oil, and the lags before it, do in a cycle, and in more where the next one
/// comes late.

namespace graben {

/// An undamped mode over `time_s` with constant flow and load, exactly: with a the missing balance
/// and v the speed beyond the flow, v turns into a and back.
struct ModeTurn {
  double cosine = 1.0;
  double travel_of_speed_s = 0.0;    ///< sin(omega h) / omega
  double travel_of_balance = 0.0;    ///< 1 - cos(omega h)
  double speed_of_balance_ps = 0.0;  ///< omega sin(omega h)
};
[[nodiscard]] ModeTurn mode_turn(double omega_radps, double time_s);

/// Weight of the newest value in a first-order lag, a cycle on.
[[nodiscard]] double newest_of_lag(double lag_s);

}  // namespace graben
