#pragma once
/// Where the machine is along the grade, without the position's noise.

#include <cmath>

namespace graben {

struct PositionState {
  double position_m = 0.0;
  bool started = false;
};

/// Position from the measured velocity, drawn to the measured position within some tenths of a
/// second; at once where they are further apart than noise and slip make them.
[[nodiscard]] inline PositionState next_position(const PositionState& last, double measured_m,
                                                 double velocity_mps, double period_s) {
  constexpr double kDrawn_s = 0.2;
  constexpr double kApart_m = 0.1;
  const double predicted_m = last.position_m + velocity_mps * period_s;
  const double off_m = measured_m - predicted_m;
  if (!last.started || !(std::abs(off_m) <= kApart_m)) {
    return {measured_m, true};
  }
  return {predicted_m + off_m * period_s / (kDrawn_s + period_s), true};
}

}  // namespace graben
