#pragma once
/// Whether the pressures are those of a machine in motion.

#include <array>

#include "firmware/excavator/excavator_profile.hpp"
#include "firmware/excavator/safety/excavator_validation.hpp"

namespace graben {

struct PressureWatchState {
  struct Sensor {
    double last_pa = 0.0;
    double stroke_m = 0.0;  ///< Up to which `way_m` is counted.
    double way_m = 0.0;     ///< To and fro, since its last change.
    double at_rail_s = 0.0;
    bool wrong = false;
  };
  /// Cap and rod side of each drive; left and right of the swing.
  std::array<std::array<Sensor, 2>, kDriveCount> sensor{};
};

struct PressureWatchResult {
  std::array<bool, kDriveCount> wrong{};  ///< One of the drive's two is not to be believed.
  PressureWatchState state;
};

/// At its rail: at or above `safety.pressure_rail_pa` for 0.3 s, longer than any peak that a port
/// relief lets stand. Stuck: the same number, to the last bit and above what a chamber without oil
/// has, while its cylinder moves by 0.06 m, to and fro. Wrong until it changes.
[[nodiscard]] PressureWatchResult watch_pressures(const ExcavatorProfile& profile,
                                                  const PressureWatchState& last,
                                                  const ValidInputs& valid, double period_s);

}  // namespace graben
