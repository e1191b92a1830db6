#pragma once
/// A machine as one run meets it: what is tried on it, and how far its controller is from knowing
/// it.

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "app/machines/simulated/simulated_excavator.hpp"

namespace graben::machines {

enum class Errors { kNone, kStrokeBias, kSensors, kParameters, kAll };

struct Scenario {
  bool soil = false;
  bool obstacle = false;
  bool air = false;        ///< The manoeuvre in the air instead of the digging path.
  bool stiff_oil = false;  ///< The paper's, for comparison with its figures.
  Errors errors = Errors::kNone;
  std::optional<double> dead_time_s;  ///< Of every spool, as the controller takes it.
  std::uint64_t seed = 0;             ///< Of everything that is drawn.
};

/// The machine with this scenario's plant, and a controller profile whose parameters are off by a
/// uniform draw within `experiment.uncertainty` of each. The plant keeps the nominal figures, but
/// for dead times, which only it has. Same seed, same draw, whatever else is switched on.
[[nodiscard]] SimulatedExcavator arranged(SimulatedExcavator machine, const Scenario& scenario);

/// Strokes of a start pose. Throws std::runtime_error where it is out of reach.
[[nodiscard]] Eigen::Vector3d strokes_at(const ExcavatorProfile& profile, const TipPose& pose);

/// Strokes that a digging machine starts at unless told: from above the path's far upper corner, as
/// it comes down. Throws as strokes_at().
[[nodiscard]] Eigen::Vector3d dig_start(const ExcavatorProfile& profile);

}  // namespace graben::machines
