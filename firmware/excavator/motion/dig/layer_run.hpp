// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Executes a program whose dig step is done in layers: each round the step is another cut, and the
/// moves round it are planned from where the last one ended to where the next one begins.

#include "firmware/excavator/motion/dig/layer_pose.hpp"

namespace graben {

/// What a cut goes by.
struct CutSeen {
  TeethPose teeth;        ///< Where they are.
  double behind_m = 0.0;  ///< See TaskWant.
  double lambda = 1.0;    ///< What fences and the machine left of the last cycle's way.
  bool force_known = false;
  Eigen::Vector2d force_n = Eigen::Vector2d::Zero();  ///< See TipLoad.
  bool payload_known = false;
  double payload_kg = 0.0;
};

/// As task_advance() has it, of a program in layers. Ends where no soil is left over the design.
void layer_advance(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                   const TaskProgram& program, double advance_s, double period_s,
                   const CutSeen& seen, TaskState& state);

/// How fast a plan in layers goes on while the teeth are behind it: `state.pace_ratio` a cycle on.
/// The sooner the nearer they are to the design: half at one slow_error, a fifth at two.
void follow_pace(const LineProfile& line, const TaskProgram& program, const CutSeen& seen,
                 double period_s, TaskState& state);

}  // namespace graben
