// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A machine that is asked to move and hardly gets on: said first, stopped later.

#include "firmware/safety/common_inputs.hpp"

namespace graben {

/// State from cycle to cycle.
struct StallState {
  /// Time in which it hardly got on, less the time in which it did: a machine that stalls for most
  /// of the time does not get on either.
  double stalled_s = 0.0;
};

/// Adds kStalling (only said) or, after `most_s`, kStalled (stops) to `inputs`.
void tell_stall(const StallState& state, double most_s, CommonValid& inputs);

/// A cycle on. `asked`: something is to move; `share` is how much of what was asked for was
/// followed, 0 .. 1. Not `active`, it begins newly. The time is bounded, so that it does not take
/// as long to get out of as it took to get in.
void next_stall(bool active, bool asked, double share, double most_s, double period_s,
                StallState& state);

}  // namespace graben
