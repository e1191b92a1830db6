// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A body that the ground before the blade holds up, or that stands on a crest: how deep the edge
/// would go if it fell now.

#include <limits>

#include "firmware/dozer/blade.hpp"
#include "firmware/dozer/travel/body_motion.hpp"

namespace graben {

/// Where body and blade are, and what the blade can do against a fall.
struct FallSituation {
  Driving driving;
  double stroke_m = 0.0;
  double blade_mps = 0.0;  ///< Asked of the cylinders; extension is positive.
  double answer_s = 0.0;   ///< Until they do something else.
  double raise_mps = 0.0;  ///< Then, with the flow that is planned with; a magnitude.
};

/// State from cycle to cycle.
struct FallState {
  FallSituation at;  ///< The fall that is being followed, so far.
  double time_s = 0.0;
  double begin_m = 0.0;  ///< Its edge over the design as it began,
  double least_m = 0.0;  ///< and the least since.
  bool followed = false;
  double sinks_m = 0.0;   ///< Below where it was, the edge in the last fall followed to its end.
  double lift_m = 0.0;    ///< Of the edge over the design, against it.
  double rate_mps = 0.0;  ///< How that changes.
  /// So fast may the machine be: slower where it sinks further than any lift makes good.
  double speed_mps = std::numeric_limits<double>::infinity();
};

/// A cycle on. From where the machine is it is followed, some steps a cycle, with nothing but the
/// ground below its tracks to hold it: the blade goes on for `answer_s` and is raised from then on.
/// By what its edge sinks meanwhile, less what the feedback makes good and no more than most of the
/// tolerance, the blade is to rise now: that takes it off the ground that bears it, and when the
/// body comes down there is room for it.
///
/// What bears the edge lets go over some way of it: the slower the machine, the longer the blade
/// has for what it sinks.
///
/// A blade that is lowered on a crest lifts the body instead of cutting; as it gives way the body
/// tips faster than any flow raises the blade.
[[nodiscard]] FallState next_fall(const DozerProfile& profile, const BladeKinematics& blade,
                                  const GroundMap& ground, const GradeProfile& design,
                                  const FallState& last, const FallSituation& now, double period_s);

}  // namespace graben
