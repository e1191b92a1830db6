// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/program/task_program.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/excavator/motion/dig/layer_plan.hpp"
#include "firmware/excavator/motion/dig/layer_pose.hpp"
#include "firmware/excavator/motion/dig/step_round.hpp"
#include "firmware/excavator/motion/program/tuning.hpp"
#include "firmware/excavator/swing.hpp"

namespace graben {
namespace {

bool unit(const Eigen::Vector3d& normal) {
  return normal.allFinite() && std::abs(normal.norm() - 1.0) < kNormalLengthOff;
}

bool not_negative(double value) { return std::isfinite(value) && value >= 0.0; }

bool usable(const Fence& fence) {
  if (!unit(fence.normal) || !std::isfinite(fence.offset_m)) {
    return false;
  }
  if (fence.is_surface()) {
    return fence.guard == FenceGuard::kTeeth && fence.surface != nullptr && fence.surface->usable();
  }
  return fence.is_plane() || (fence.guard == FenceGuard::kMachine && fence.centre_m.allFinite() &&
                              fence.half_m.allFinite() && fence.half_m.minCoeff() > 0.0 &&
                              (fence.shape == FenceShape::kCylinder || fence.normal.z() == 0.0));
}

bool usable(const FenceSet& fences, int most) {
  if (fences.count < 0 || fences.count > most) {
    return false;
  }
  return std::all_of(fences.fence.begin(), fences.fence.begin() + fences.count,
                     [](const Fence& f) { return usable(f); });
}

bool usable(const DesignPlane& design) {
  return design.through_m.allFinite() && unit(design.up) && design.up.z() > kDesignUpLeast &&
         not_negative(design.clearance_m);
}

bool usable(const StepUntil& until) {
  switch (until.kind) {
    case UntilKind::kEnd:
      return true;
    case UntilKind::kFull:
    case UntilKind::kForce:
      return std::isfinite(until.most) && until.most > 0.0;
    case UntilKind::kPlane:
      return unit(until.normal) && std::isfinite(until.offset_m);
  }
  return false;
}

/// A line's pace and poses are plan_line's to judge.
bool usable(const StepRequest& step) {
  if (step.kind == StepKind::kWait) {
    return !step.straight && step.until.kind == UntilKind::kEnd;
  }
  const bool kind = step.kind >= StepKind::kDig && step.kind <= StepKind::kReturnToDig;
  return kind && (step.straight ? usable(step.until)
                                : step.until.kind == UntilKind::kEnd && step.pace_ratio > 0.0 &&
                                      step.pace_ratio <= 1.0 && not_negative(step.duration_s));
}

/// A full bucket is known by what it holds and by what the edge has passed on its way.
bool can_fill(const ExcavatorProfile& profile, const ProgramRequest& request) {
  const ExcavatorBody& body = profile.geometry.body;
  TeethPose from = request.start;
  int fills = 0;
  bool can = true;
  for (int i = 0; i < request.step_count; ++i) {
    const StepRequest& step = request.step[static_cast<unsigned>(i)];
    if (step.until.kind == UntilKind::kFull) {
      const Eigen::Vector3d way_m = step.to.position_m - from.position_m;
      can = can && way_m.head<2>().norm() >= kFillLevelWay_m && step.kind == StepKind::kDig &&
            body.known() && body.capacity_m3 > 0.0;
      ++fills;
    }
    from = step.kind == StepKind::kWait ? from : step.to;
  }
  return can && fills <= 1;
}

/// A wait's second, in which it is seen to stand.
constexpr SineRamp kWaitRamp{1.0, 0.5};

bool same(const TeethPose& a, const TeethPose& b) {
  return (a.position_m - b.position_m).norm() < kSamePose_m &&
         std::abs(a.attitude_rad - b.attitude_rad) < kSamePose_rad;
}

bool usable_layers(const ExcavatorProfile& profile, const ProgramRequest& request) {
  const auto* const first = request.step.begin();
  const auto* const end = first + request.step_count;
  const bool moves = std::none_of(
      first + 1, end, [](const StepRequest& step) { return step.straight || step.in_layers; });
  const ExcavatorBody& body = profile.geometry.body;
  return moves && request.step_count > 1 && first->straight && first->kind == StepKind::kDig &&
         request.repeats && request.has_design && body.known() && body.capacity_m3 > 0.0 &&
         std::isfinite(first->ground_m) && first->strips >= 1 && first->strips <= kStripMost &&
         std::isfinite(first->strip_rad);
}

/// Plans one program.
class Planning {
 public:
  Planning(const ExcavatorProfile& profile, const ProgramRequest& request)
      : profile_(profile),
        request_(request),
        kinematics_(profile.geometry),
        limits_(drive_limits(profile)) {}

  [[nodiscard]] ProgramResult run();

 private:
  [[nodiscard]] bool usable_request() const;
  void raise_digging(bool closed);
  [[nodiscard]] bool plan_step(int number);
  [[nodiscard]] bool plan_straight(const StepRequest& asked, TaskStep& step, StepNote& note,
                                   int number);
  [[nodiscard]] bool plan_move(const StepRequest& asked, TaskStep& step, int number);
  [[nodiscard]] bool keeps_free(const TaskStep& step, int number);
  [[nodiscard]] bool plan_in_layers();
  [[nodiscard]] bool strips_in_range();
  /// Always false.
  bool refuse(ProgramRefusal why, int step, const BlindPlace& place = {});

  /// Of the pose that step `number` begins at; of its end with number + 1. A wait's are one.
  [[nodiscard]] TeethPose& pose(int number) { return pose_[at(number)]; }
  [[nodiscard]] unsigned at(int number) const { return at_[static_cast<unsigned>(number)]; }

  const ExcavatorProfile& profile_;
  const ProgramRequest& request_;
  SwingKinematics kinematics_;
  DriveLimits limits_;
  std::array<TeethPose, kStepMost + 1> pose_;
  std::array<std::uint8_t, kStepMost + 1> at_{};
  DriveVector drives_ = DriveVector::Zero();  ///< Where the steps planned so far end.
  ProgramResult result_;
};

bool Planning::refuse(ProgramRefusal why, int step, const BlindPlace& place) {
  result_.refusal = why;
  result_.step = step;
  result_.place = place;
  return false;
}

bool Planning::usable_request() const {
  const int fence_most = request_.has_design ? kFenceMost - 1 : kFenceMost;
  return request_.step_count > 0 && request_.step_count <= kStepMost &&
         std::isfinite(request_.ground_m) && request_.rounds.offset_m.allFinite() &&
         can_fill(profile_, request_) && usable(request_.fences, fence_most) &&
         (!request_.has_design || usable(request_.design)) &&
         std::all_of(request_.step.begin(), request_.step.begin() + request_.step_count,
                     [](const StepRequest& step) { return usable(step); });
}

/// A line between two ends that keep the clearance keeps it all along. What is `closed` stays so:
/// one pose, raised as the end of the one step or as the beginning of the other.
void Planning::raise_digging(bool closed) {
  std::array<double, kStepMost + 1> raised_m{};
  for (int i = 0; i < request_.step_count; ++i) {
    const StepRequest& step = request_.step[static_cast<unsigned>(i)];
    if (step.kind != StepKind::kDig || !step.straight) {
      continue;
    }
    for (const int end : {i, i + 1}) {
      const double missing_m =
          request_.design.clearance_m - request_.design.height_m(pose(end).position_m);
      const double up_m = std::max(0.0, missing_m / request_.design.up.z());
      pose(end).position_m.z() += up_m;
      raised_m[at(end)] += up_m;
    }
  }
  const int count = request_.step_count;
  if (closed) {
    TeethPose& end = pose(count);
    end.position_m.z() = std::max(end.position_m.z(), pose_[0].position_m.z());
    pose_[0] = end;
    raised_m[0] = raised_m[at(count)] = std::max(raised_m[0], raised_m[at(count)]);
  }
  for (int i = 0; i < count; ++i) {
    StepNote& note = result_.note[static_cast<unsigned>(i)];
    note.raised_from_m = raised_m[at(i)];
    note.raised_to_m = raised_m[at(i + 1)];
  }
}

bool Planning::plan_straight(const StepRequest& asked, TaskStep& step, StepNote& note, int number) {
  LineRequest line{pose(number), pose(number + 1), profile_.line.acceleration_mps2};
  line.duration_s = asked.duration_s;
  line.speed_mps = asked.speed_mps;
  const PlanResult plan = plan_line(kinematics_, limits_, line);
  switch (plan.refusal) {
    case PlanRefusal::kNone:
      break;
    case PlanRefusal::kNoWay:
      return refuse(ProgramRefusal::kNoWay, number);
    case PlanRefusal::kBlindSpot:
      return refuse(ProgramRefusal::kBlindSpot, number, plan.blind);
    default:
      return refuse(ProgramRefusal::kBadRequest, number);
  }
  step.line = plan.plan;
  note.slowed_by = plan.slowed_by;
  note.drive = plan.drive;
  note.slowed_ratio = plan.slowed_ratio;
  drives_ = line_motion(kinematics_, step.line.line, 1.0).value;
  return true;
}

bool Planning::plan_move(const StepRequest& asked, TaskStep& step, int number) {
  if (asked.kind == StepKind::kWait) {
    step.drives = {drives_, DriveVector::Zero(), kWaitRamp};
    return true;
  }
  DriveResult to = kinematics_.drive_from_teeth(pose(number + 1));
  if (result_.program.leads_on && number + 1 == request_.step_count) {
    // Back to over the first cut: down to its line only the cut leads.
    to.value = result_.program.start;
    to.blind = {};
  }
  if (to.blind.kind != BlindKind::kNone) {
    return refuse(ProgramRefusal::kBlindSpot, number, {to.blind, 1.0, pose(number + 1)});
  }
  step.pace_ratio = asked.pace_ratio;
  step.least_s = asked.duration_s;
  step.drives = plan_drives(limits_, drives_, to.value, {asked.pace_ratio, asked.duration_s});
  if (!(step.drives.ramp.duration_s > 0.0)) {
    return refuse(ProgramRefusal::kNoWay, number);
  }
  drives_ = to.value;
  return true;
}

bool Planning::keeps_free(const TaskStep& step, int number) {
  const BarredPlace barred =
      first_barred_place(profile_, kinematics_, result_.program.fences, step);
  result_.by = static_cast<const BarredBy&>(barred);
  return barred.why == ProgramRefusal::kNone || refuse(barred.why, number, barred.place);
}

bool Planning::plan_step(int number) {
  const auto i = static_cast<unsigned>(number);
  const StepRequest& asked = request_.step[i];
  TaskStep& step = result_.program.step[i];
  step.kind = asked.kind;
  step.straight = asked.straight;
  step.until = asked.until;
  result_.program.ends_early = result_.program.ends_early || asked.until.kind != UntilKind::kEnd;
  const bool planned = asked.straight ? plan_straight(asked, step, result_.note[i], number)
                                      : plan_move(asked, step, number);
  if (!planned) {
    return false;
  }
  if (!profile_.has_swing() && std::abs(swing_of(drives_)) > kSamePose_rad) {
    return refuse(ProgramRefusal::kNoSwing, number, {{}, 1.0, pose(number + 1)});
  }
  return keeps_free(step, number);
}

bool Planning::strips_in_range() {
  const LayerPlan& plan = result_.program.layers;
  for (const int strip : {0, plan.strips - 1}) {
    const double swing_rad = swing_of(drives_) + plan.first_rad + strip * plan.strip_rad;
    const bool inside = profile_.has_swing() ? swing_rad <= profile_.swing.left_end_rad &&
                                                   swing_rad >= profile_.swing.right_end_rad
                                             : std::abs(swing_rad) <= kSamePose_rad;
    if (!inside) {
      return refuse(profile_.has_swing() ? ProgramRefusal::kSwingEnd : ProgramRefusal::kNoSwing, 0,
                    {{}, 1.0, pose(1)});
    }
  }
  return true;
}

/// The first step's line is planned. Where a cut may begin and end is looked at as a whole; the
/// moves are planned from where the last one lifts out.
bool Planning::plan_in_layers() {
  TaskProgram& program = result_.program;
  const LayerPlanResult layers = plan_layers(profile_, kinematics_, request_, program);
  if (layers.place.blind.kind != BlindKind::kNone) {
    return refuse(ProgramRefusal::kBlindSpot, 0, layers.place);
  }
  program.layers = layers.plan;
  program.leads_on = true;
  if (!strips_in_range()) {
    return false;
  }
  const TeethPose first = first_dig_pose(kinematics_, program);
  const DriveResult start = kinematics_.drive_from_teeth(first);
  if (start.blind.kind != BlindKind::kNone) {
    return refuse(ProgramRefusal::kBlindSpot, 0, {start.blind, 0.0, first});
  }
  program.start = start.value;
  const LinePlan lift = lift_line(profile_, kinematics_, program.layers,
                                  program.step[0].line.line.at(1.0), LiftPart::kOut);
  drives_ = line_motion(kinematics_, lift.line, 1.0).value;
  return true;
}

ProgramResult Planning::run() {
  if (!usable_request()) {
    return result_;
  }
  pose(0) = request_.start;
  for (int i = 0; i < request_.step_count; ++i) {
    const StepRequest& step = request_.step[static_cast<unsigned>(i)];
    const bool waits = step.kind == StepKind::kWait;
    at_[static_cast<unsigned>(i + 1)] =
        waits ? at_[static_cast<unsigned>(i)] : static_cast<std::uint8_t>(i + 1);
    pose(i + 1) = waits ? pose(i) : step.to;
  }
  const bool closed = same(pose(request_.step_count), pose(0));
  TaskProgram& program = result_.program;
  program.fences = request_.fences;
  if (request_.has_design) {
    raise_digging(closed);
    program.fences.fence[static_cast<unsigned>(program.fences.count++)] = request_.design.fence();
  }
  const DriveResult start = kinematics_.drive_from_teeth(pose(0));
  if (start.blind.kind != BlindKind::kNone) {
    refuse(ProgramRefusal::kBlindSpot, 0, {start.blind, 0.0, pose(0)});
    return result_;
  }
  if (!profile_.has_swing() && std::abs(swing_of(start.value)) > kSamePose_rad) {
    refuse(ProgramRefusal::kNoSwing, 0, {{}, 0.0, pose(0)});
    return result_;
  }
  program.start = drives_ = start.value;
  if (request_.step[0].in_layers && !usable_layers(profile_, request_)) {
    refuse(ProgramRefusal::kLayers, 0, {{}, 0.0, pose(0)});
    return result_;
  }
  for (int i = 0; i < request_.step_count; ++i) {
    if (!plan_step(i) || (i == 0 && request_.step[0].in_layers && !plan_in_layers())) {
      return result_;
    }
  }
  if (request_.repeats && !closed) {
    refuse(ProgramRefusal::kOpenEnd, request_.step_count - 1, {{}, 1.0, pose(request_.step_count)});
    return result_;
  }
  program.step_count = request_.step_count;
  program.repeats = request_.repeats;
  program.ground_m = request_.ground_m;
  program.end = drives_;
  if (plan_rounds(profile_, kinematics_, request_, result_) &&
      plan_early_ends(profile_, kinematics_, result_)) {
    result_.refusal = ProgramRefusal::kNone;
  }
  return result_;
}

}  // namespace

ProgramResult plan_program(const ExcavatorProfile& profile, const ProgramRequest& request) {
  return Planning(profile, request).run();
}

}  // namespace graben
