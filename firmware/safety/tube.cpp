// SPDX-License-Identifier: Apache-2.0
#include "firmware/safety/tube.hpp"

#include <algorithm>
#include <cmath>

namespace graben {

void tell_tube(const TubeState& state, CommonValid& inputs) {
  if (state.outside) {
    FaultSet left;
    left.add(Fault::kPathLeft);
    stop(left, inputs);
  }
}

void next_tube(bool active, double error_m, double tube_m, TubeState& state) {
  if (!active) {
    state = {};
    return;
  }
  state.nearest_m = std::min(state.nearest_m, error_m);
  state.outside = !std::isfinite(error_m) || error_m > state.nearest_m + tube_m;
}

void next_tube_above(bool active, double error_m, double tube_m, TubeState& state) {
  next_tube(active, std::max(error_m, 0.0), tube_m, state);
  state.outside = state.outside || (active && !(error_m >= -tube_m));
}

}  // namespace graben
