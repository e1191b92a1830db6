// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How fast a plan in layers goes on while the teeth are behind it.

#include "firmware/excavator/motion/dig/layer_run.hpp"

namespace graben {

/// `state.pace_ratio` a cycle on. Of teeth that are behind their plan, the sooner the nearer they
/// are to the design: half at one slow_error, a fifth at two.
void follow_pace(const LineProfile& line, const TaskProgram& program, const CutSeen& seen,
                 double period_s, TaskState& state);

}  // namespace graben
