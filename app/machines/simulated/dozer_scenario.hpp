#pragma once
/// A dozer as one run meets it: how fast it is asked to go, and how far its controller is from
/// knowing it.

#include <cstdint>
#include <optional>

#include "app/machines/simulated/simulated_dozer.hpp"

namespace graben::machines {

struct DozerScenario {
  SpeedPolicy policy = SpeedPolicy::kBounded;
  std::optional<double> speed_mps;     ///< v_d; the profile's unless told.
  std::optional<double> engine_radps;  ///< Where the throttle stands; the profile's unless told.
  bool errors = false;                 ///< The machine is drawn: draw_dozer.
  std::uint64_t seed = 0;              ///< Of everything that is drawn.
};

/// The machine with this scenario's plant, and a controller profile with its policy and speed. The
/// engine's speed is the machine's alone: the controller has to take it from the bus. Throws
/// std::runtime_error where it is out of the profile's range.
[[nodiscard]] SimulatedDozer arranged(SimulatedDozer machine, const DozerScenario& scenario);

}  // namespace graben::machines
