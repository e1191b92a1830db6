#pragma once
/// Executes a program whose dig step is done in layers: each round the step is another cut, and the
/// moves round it are planned from where the last one ended to where the next one begins.

#include "firmware/excavator/tasks/task_run.hpp"

namespace graben {

[[nodiscard]] inline bool in_layers(const TaskProgram& program) { return program.layers.step >= 0; }

/// What a cut goes by.
struct CutSeen {
  TeethPose teeth;        ///< Where they are.
  double behind_m = 0.0;  ///< See TaskWant.
  double lambda = 1.0;    ///< Of the last cycle.
  bool force_known = false;
  Eigen::Vector2d force_n = Eigen::Vector2d::Zero();  ///< See TipLoad.
};

/// True while the edge goes down into the ground or through it.
[[nodiscard]] bool cuts(const TaskProgram& program, const TaskState& state);

/// The line that the edge follows now: the step's, over its layer and at its strip.
[[nodiscard]] TeethLine cut_line(const TaskProgram& program, const TaskState& state);

/// As task_aim() has it, of a step of a program in layers.
[[nodiscard]] TaskAim layer_aim(const SwingKinematics& kinematics, const TaskProgram& program,
                                const TaskState& state);

/// As task_advance() has it, of a program in layers. Ends where no soil is left over the design.
[[nodiscard]] TaskState layer_advance(const ExcavatorProfile& profile,
                                      const SwingKinematics& kinematics, const TaskProgram& program,
                                      const TaskState& state, double advance_s, double period_s,
                                      const CutSeen& seen);

/// Where the first cut begins.
[[nodiscard]] TeethPose first_cut_pose(const TaskProgram& program);

/// The way of teeth that have ended a cut here: first the bucket is folded in while its edge still
/// stands before soil, which keeps the fill in; then it is lifted out of the ground. Without a way
/// where the machine can't lift it.
[[nodiscard]] LinePlan lift_line(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                                 const LayerPlan& plan, const TeethPose& from, bool folds);

/// Teeth on a cut, so high over the line; the bucket stands steep as it goes into uncut ground,
/// its floor along its way, and is turned to the line's attitude on the first half metre.
[[nodiscard]] TeethPose cut_pose(const TaskProgram& program, const Cut& cut, double share,
                                 double height_m);

/// Share of the steep attitude that the machine can have where a cut begins.
[[nodiscard]] double steepest(const SwingKinematics& kinematics, const TaskProgram& program,
                              Cut cut);

/// The step's line at a strip, so high over itself.
[[nodiscard]] TeethLine line_over(const TaskProgram& program, int strip, double height_m);

}  // namespace graben
