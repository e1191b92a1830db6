// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Height of a cut over its line: where the teeth are, and how a plan goes up and down.

#include "firmware/excavator/motion/dig/layer_run.hpp"

namespace graben {

/// One cycle of a program in layers. `advance_s` is what the plan may go on by before its own pace.
struct LayerCycle {
  const TaskProgram& program;
  const SwingKinematics& kinematics;
  double advance_s = 0.0;
  double period_s = 0.0;
};

/// A heavy cut gives way upwards so fast.
inline constexpr double kGives_mps = 0.15;
inline constexpr double kHeightChange_mps2 = 1.0;

/// Of the teeth over the strip's line, counted from the ground where that has been felt for.
[[nodiscard]] double seen_height_m(const TaskProgram& program, const CutSeen& seen,
                                   const TaskState& state);

/// Height that the cut is to have here. The last one keeps a little more where the bucket is still
/// steep: there its zero moves the edge the other way than where the ground was felt for.
[[nodiscard]] double wanted_height_m(const TaskProgram& program, const LayerState& layers);

/// Up or down to a height over the line, with bounded acceleration. Where the machine can't be it
/// stays as high as it is.
void rise(const LayerCycle& cycle, double target_m, double most_down_mps, TaskState& state);

/// How the edge comes down to a cut: quickly through the air, into the ground as hard as it may,
/// and then its oil lets off: pressed oil would throw it down as soon as it goes along and the
/// ground bears it no more. A cycle on. Begins the cut where it is down, or can't be pressed down
/// further: the rest it comes down on the way.
void enter_on(const LayerCycle& cycle, const CutSeen& seen, TaskState& state);

}  // namespace graben
