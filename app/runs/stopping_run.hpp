// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How far a simulated machine goes on once somebody outside has decided that it stops.

#include <string>
#include <vector>

#include "app/machines/simulated/simulated_dozer.hpp"
#include "app/machines/simulated/simulated_excavator.hpp"

namespace graben::runs {

/// One stop. All true, of the teeth or of the dozer's body.
struct Stopping {
  std::string motion;  ///< "swing", "digging path", "travel".
  double speed_ratio = 1.0;
  double load_kg = 0.0;     ///< In the bucket.
  double speed_mps = 0.0;   ///< As the source decides,
  double time_s = 0.0;      ///< from then until it is slower than kStands_mps for good,
  double distance_m = 0.0;  ///< and the farthest that it comes from where it was then.
};

/// Slower than that a machine stands; it may still ring on its oil. [m/s]
inline constexpr double kStands_mps = 0.02;

/// Shares of full speed that are tried.
inline constexpr double kStopSpeeds[] = {1.0, 0.6, 0.3, 0.1};

/// A stop that the operator has to end, decided where the motion is fastest (found by a run without
/// one, of 12 s) and just after a frame of ExternalLimit has gone out:
/// its period is in the figures, whatever a detector needs before it is not. An excavator with a
/// swing drive swings by its lever; every one follows its digging path. Both with the bucket empty,
/// and full of loose soil where the profile says what it holds.
[[nodiscard]] std::vector<Stopping> stopping(const machines::SimulatedExcavator& machine);
/// On its grade, without soil but what its profile has.
[[nodiscard]] std::vector<Stopping> stopping(const machines::SimulatedDozer& machine);

}  // namespace graben::runs
