// SPDX-License-Identifier: Apache-2.0
#pragma once
/// An operator who puts the bucket's edge on a peg in several postures, on a simulated machine with
/// IMUs: what `measure-up` needs. He moves one lever a drive and goes by what he sees, the true
/// edge and the true peg: what controller and IMUs take the pose to be does not lead him.

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "app/machines/simulated/simulated_excavator.hpp"
#include "app/runs/logged_run.hpp"
#include "firmware/core/generated/codes.hpp"

namespace graben::runs {

/// One posture on a peg.
struct WantedTouch {
  std::size_t peg = 0;
  Eigen::Vector3d strokes_m = Eigen::Vector3d::Zero();
};

struct TouchOptions {
  std::vector<Eigen::Vector2d> pegs_m;  ///< From the boom foot's pin: ahead, up.
  std::vector<WantedTouch> touches;
  double rest_s = 12.0;  ///< So long each is held.
  /// The operator's eye: so far the edge may be off its peg, and a level off a peg's height.
  double eye_m = 0.006;
  double level_m = 0.002;
  std::uint64_t seed = 0;          ///< Of eye and level.
  std::filesystem::path log_file;  ///< candump log; none if empty.
};

enum class TouchEnd { kDone, kFault, kTooLong };

struct TouchRunResult {
  TouchEnd end = TouchEnd::kDone;
  Fault fault = Fault::kNone;  ///< With kFault.
  std::size_t touched = 0;
  double machine_s = 0.0;
  std::vector<double> off_m;     ///< Of each touch: the true edge off its peg.
  std::vector<double> height_m;  ///< Of each peg over the boom foot's pin, as a level shows it.
};

/// Pegs a little above the ground, each where the bucket can turn far about it, and `each` postures
/// on every one, from curled to opened. Throws std::runtime_error where the machine reaches none.
[[nodiscard]] TouchOptions usual_touches(const machines::SimulatedExcavator& machine,
                                         std::size_t pegs, std::size_t each);

[[nodiscard]] TouchRunResult run_touches(const machines::SimulatedExcavator& machine,
                                         const TouchOptions& options, const Progress& progress);

}  // namespace graben::runs
