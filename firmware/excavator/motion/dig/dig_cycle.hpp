// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What one cycle of a dig goes by.

#include "firmware/excavator/excavator_profile.hpp"
#include "firmware/excavator/motion/program/task_run.hpp"

namespace graben {

/// What is seen of the machine.
struct CutSeen {
  TeethPose teeth;        ///< Where they are.
  double behind_m = 0.0;  ///< See TaskWant.
  double lambda = 1.0;    ///< What fences and the machine left of the last cycle's way.
  bool force_known = false;
  Eigen::Vector2d force_n = Eigen::Vector2d::Zero();  ///< See TipLoad.
  bool payload_known = false;
  double payload_kg = 0.0;
};

/// One cycle of one program in layers.
struct DigCycle {
  const ExcavatorProfile& profile;
  const SwingKinematics& kinematics;
  const TaskProgram& program;
  double advance_s;  ///< What the plan may go on by before its own pace; not below 0.
  double period_s;
  const CutSeen& seen;

  [[nodiscard]] const LayerPlan& plan() const { return program.layers; }
  [[nodiscard]] int after(int step) const { return (step + 1) % program.step_count; }
  [[nodiscard]] int before_cut() const {
    return (program.layers.step + program.step_count - 1) % program.step_count;
  }
};

}  // namespace graben
