// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A tube around what a machine is to follow: path, plan, line, design surface. Whatever pushes the
/// tool out of it, or makes the controller lead it out, stops the machine.

#include <limits>

#include "firmware/safety/common_inputs.hpp"

namespace graben {

/// State from cycle to cycle; as constructed nothing has been followed yet.
struct TubeState {
  double nearest_m = std::numeric_limits<double>::infinity();  ///< So near it has been to it.
  bool outside = false;
};

/// Adds kPathLeft where the tool is outside.
void tell_tube(const TubeState& state, CommonValid& inputs);

/// A cycle on. `error_m` is how far the tool is from what it follows, 0 or more. It may begin
/// anywhere: it has to stay nearer than the nearest that it has been, plus `tube_m`. What is not a
/// number is outside. Not `active`, nothing is followed, and the next task begins newly.
void next_tube(bool active, double error_m, double tube_m, TubeState& state);

/// The same of a surface that is to be made: `error_m` is the tool's height above it. Below it, it
/// may never be further than `tube_m`: what is cut away is gone.
void next_tube_above(bool active, double error_m, double tube_m, TubeState& state);

}  // namespace graben
