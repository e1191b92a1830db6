// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A task as a sequence of steps, planned from end to end and looked at as a whole before anything
/// moves.

#include "firmware/excavator/excavator_profile.hpp"
#include "firmware/excavator/fences/site_frame.hpp"
#include "firmware/excavator/motion/dig/dig_layers.hpp"
#include "firmware/excavator/motion/program/drive_plan.hpp"
#include "firmware/excavator/motion/program/line_plan.hpp"
#include "firmware/excavator/motion/program/tuning.hpp"

namespace graben {

/// Most steps of a program. [-; size: of TaskProgram]
inline constexpr int kStepMost = 24;
/// Most programs that can be chosen. [-; size: of TaskBook]
inline constexpr int kTaskMost = 4;

/// What ends a straight step before its planned end; kEnd: nothing does.
struct StepUntil {
  UntilKind kind = UntilKind::kEnd;
  /// kFull: so much of the bucket's capacity; kForce: so much on the teeth, N.
  double most = 0.0;
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< kPlane: the teeth have come to it where
  double offset_m = 0.0;                              ///< normal . position >= offset.
};

/// How often a program is done, and how much farther each round digs.
struct RoundsPlan {
  int count = 0;           ///< 0: once, or for ever if it repeats.
  bool to_design = false;  ///< As often as brings every dig down to the design; `count` is found.
  /// From round to round, of all that straight digs begin and end at. The design's clearance is
  /// kept, see plan_program().
  Eigen::Vector3d offset_m = Eigen::Vector3d::Zero();
  bool has_design = false;  ///< The program's.
  DesignPlane design;

  [[nodiscard]] bool is_bounded() const { return count > 0 || to_design; }
};

/// A step as it is asked for: from where the one before ends. A wait ends there, whatever `to`
/// says.
struct StepRequest {
  StepKind kind = StepKind::kNone;
  TeethPose to;
  bool straight = true;    ///< A straight line of the teeth; else a move straight in drive space.
  double speed_mps = 0.0;  ///< Of a line, as in LineRequest: either this or the duration.
  double duration_s = 0.0;
  double pace_ratio = 1.0;  ///< Of a drive move, see DrivePace.
  StepUntil until{};
  // Of a straight dig, the program's first step, that is done in layers until its design is met.
  bool in_layers = false;
  double ground_m = 0.0;   ///< Height of the ground as it is before, over the ground frame.
  bool touches = false;    ///< That ground is felt for first, and heights are counted from it.
  int strips = 1;          ///< Side by side, about the swing axis, the line in their middle.
  double strip_rad = 0.0;  ///< From one to the next.
};

struct ProgramRequest {
  TeethPose start;
  std::array<StepRequest, kStepMost> step;
  int step_count = 0;
  bool repeats = false;   ///< Its last step has to end where it starts.
  RoundsPlan rounds{};    ///< Of one that repeats; has_design and design are set by planning.
  double ground_m = 0.0;  ///< Of the ground as it is before, for StepUntil: kFull.
  FenceSet fences;        ///< With a design plane one less than there is room for.
  bool has_design = false;
  DesignPlane design;
};

struct TaskStep {
  StepKind kind = StepKind::kNone;
  bool straight = true;
  LinePlan line;            ///< Where it is straight.
  DrivePlan drives;         ///< Where it is not.
  double pace_ratio = 1.0;  ///< Of a move that is planned again on the way, see DrivePace,
  double least_s = 0.0;     ///< and its duration at least.
  StepUntil until{};
  bool from_moves = false;  ///< By RoundsPlan::offset_m, where it begins,
  bool to_moves = false;    ///< and where it ends.

  [[nodiscard]] double duration_s() const {
    return straight ? line.ramp.duration_s : drives.ramp.duration_s;
  }
};

/// All that an executor needs. As constructed there is none.
struct TaskProgram {
  std::array<TaskStep, kStepMost> step;
  int step_count = 0;
  bool repeats = false;
  RoundsPlan rounds{};
  bool ends_early = false;  ///< A step has an `until`.
  double ground_m = 0.0;
  DriveVector start = DriveVector::Zero();  ///< Drives at the first pose.
  DriveVector end = DriveVector::Zero();    ///< Drives at the last.
  FenceSet fences;                          ///< The design surface is the last of them.
  LayerPlan layers;                         ///< Of the step that is dug in layers, if one is.
  bool leads_on = false;  ///< Each part begins wherever the one before it has ended.
};

/// Programs that can be chosen over the bus, by task number from 0.
struct TaskBook {
  std::array<TaskProgram, kTaskMost> program;
  int count = 0;
  SitePoints site;  ///< Of all of them: the machine stands in one place.

  /// Whose fences and design hold what moves by the levers: that which is chosen, or the first.
  [[nodiscard]] const TaskProgram& chosen(int number) const {
    return program[number >= 0 && number < count ? static_cast<unsigned>(number) : 0U];
  }

  /// A bit each, the first one the lowest: those with steps. The others only have fences and a
  /// design, for what moves by the levers.
  [[nodiscard]] std::uint32_t with_steps() const {
    std::uint32_t bits = 0;
    for (unsigned i = 0; i < kTaskMost; ++i) {
      const bool has = static_cast<int>(i) < count && program[i].step_count > 0;
      bits |= has ? 1U << i : 0U;
    }
    return bits;
  }
};
static_assert(sizeof(TaskBook) < 32 * 1024, "a controller's memory holds it beside all else");

/// Why there is no program.
enum class ProgramRefusal : std::uint8_t {
  kNone = 0,
  kBadRequest = 1,  ///< A number is not finite, out of its range, or not one of the two paces.
  kNoWay = 2,       ///< The step ends where it begins.
  kBlindSpot = 3,   ///< The machine can't be at `place`, or can't move from there.
  kFence = 4,       ///< `point` of the machine comes too near to `fence` from `place` on.
  kSwingEnd = 5,    ///< The swing leaves its range at `place`.
  kNoSwing = 6,     ///< It would have to turn, and no drive of this machine does.
  kOpenEnd = 7,     ///< It repeats, but its end is not its start.
  kLayers = 8,      ///< Digs in layers, but not first, without design, moves or a known bucket.
  kRounds = 9,      ///< None, too many, not closed, or to a design that they do not lead to.
};

/// Changes that planning made to a step.
struct StepNote {
  double raised_from_m = 0.0;  ///< Its beginning, straight up, to keep the design's clearance,
  double raised_to_m = 0.0;    ///< and its end.
  PlanLimit slowed_by = PlanLimit::kNone;  ///< As in PlanResult; of a line.
  int drive = 0;
  double slowed_ratio = 1.0;
};

/// What comes too near to which fence: where it is nearest.
struct BarredBy {
  int fence = 0;
  MachinePoint point = MachinePoint::kTeeth;
  double least_share = 0.0;  ///< Of the step; to a step of the walk.
  double least_m = 0.0;      ///< Its distance there; negative: beyond the fence.
  double margin_m = 0.0;     ///< What it should be, planned_margin_m().
};

struct ProgramResult {
  ProgramRefusal refusal = ProgramRefusal::kBadRequest;
  int step = 0;      ///< Which, from 0; the start belongs to the first.
  BlindPlace place;  ///< Share of the step and teeth there; `blind` only where it is one.
  BarredBy by;       ///< Of kFence.
  int round = -1;    ///< In which, from 0; below: in any.
  /// At 0 or above: the step is that after one which its `until` has ended at this share.
  double early_share = -1.0;
  std::array<StepNote, kStepMost> note;
  TaskProgram program;  ///< Valid only if nothing is refused.
};

/// Every step planned from where the one before ends, then walked against swing range and fences.
/// Both ends of a straight `dig` step that are lower than the clearance above the design plane are
/// raised to it, straight up; with them the whole line is, and a step before or after it meets it
/// where it now begins or ends (see StepNote). The design surface itself then is one more fence,
/// for the teeth: no other step may go below it either.
///
/// The approach from wherever the machine stands is no part of it: see task_start.
///
/// Not for a control cycle: some 500 poses a step, at most 21000 and 40000 a fence.
[[nodiscard]] ProgramResult plan_program(const ExcavatorProfile& profile,
                                         const ProgramRequest& request);

/// The first place that is not left to the machine.
struct BarredPlace : BarredBy {
  ProgramRefusal why = ProgramRefusal::kNone;  ///< kNone: there is none.
  BlindPlace place;  ///< Its share to 1e-12; `blind` only where the points are not known.
};

/// Drives of a step at this share of it, and their derivatives by the share.
[[nodiscard]] DriveMotion step_motion(const SwingKinematics& kinematics, const TaskStep& step,
                                      double share);

/// Walks a step that meets no blind spot in kWalkSteps steps, and looks between them wherever a
/// distance has its least there. From fences it has to keep planned_margin_m().
[[nodiscard]] BarredPlace first_barred_place(const ExcavatorProfile& profile,
                                             const SwingKinematics& kinematics,
                                             const FenceSet& fences, const TaskStep& step);

}  // namespace graben
