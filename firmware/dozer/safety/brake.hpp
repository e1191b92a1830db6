#pragma once
/// When the dozer asks for its parking brake.

#include "firmware/dozer/safety/dozer_validation.hpp"
#include "firmware/safety/mode.hpp"

namespace graben {

/// Slower than this a track stands.
inline constexpr double kTrackAtRest_mps = 0.05;
/// Without the tracks' speeds the machine counts as at rest after this; with its pumps at 0 it is.
inline constexpr double kCoasting_s = 1.0;

/// What is kept of the brake from cycle to cycle.
struct BrakeState {
  bool wanted = true;
  double coasting_s = 0.0;  ///< Since the last motion.
};

/// Wanted at once while a displacement runs away or has stopped the machine by that. In motion not.
/// Otherwise from when both tracks have come to rest, and then until the next motion: a machine
/// that is dragged downhill keeps its brake. In manual mode only while the tracks are at rest: the
/// machine is its operator's. `mode` is this cycle's.
[[nodiscard]] BrakeState brake(const BrakeState& last, const ModeState& mode,
                               const DozerValid& valid, double period_s);

}  // namespace graben
