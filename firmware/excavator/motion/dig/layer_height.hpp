// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Height of a cut over its line: where the teeth are, and how a plan goes up and down.

#include "firmware/excavator/motion/dig/dig_cycle.hpp"

namespace graben {

/// Of the teeth over the strip's line, counted from the ground where that has been felt for.
[[nodiscard]] double seen_height_m(const TaskProgram& program, const CutSeen& seen,
                                   const TaskState& state);

/// Height that the cut is to have here. The last one keeps a little more where the bucket is still
/// steep: there its zero moves the edge the other way than where the ground was felt for.
[[nodiscard]] double wanted_height_m(const TaskProgram& program, const TaskState& state);

/// Up or down to a height over the line, with bounded acceleration. Where the machine can't be it
/// stays as high as it is.
void rise(const DigCycle& cycle, double target_m, double most_down_mps, TaskState& state);

}  // namespace graben
