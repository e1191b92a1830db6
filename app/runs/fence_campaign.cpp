// SPDX-License-Identifier: Apache-2.0
#include "app/runs/fence_campaign.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "app/plant/random.hpp"
#include "app/runs/autodig_run.hpp"
#include "app/runs/fence_truth.hpp"

namespace graben::runs {
namespace {

constexpr int kTries = 400;
/// Poses along each step.
constexpr int kLooks = 24;
/// A fence is so far from the way at most, and so much nearer than it can be planned at.
constexpr double kNear_m = 0.5;
constexpr double kTooNear_m = -0.05;
/// The machine begins so far from every fence at least.
constexpr double kFree_m = 0.03;

DriveVector random_drives(const ExcavatorProfile& profile, plant::Random& random) {
  DriveVector drives = DriveVector::Zero();
  for (unsigned i = 0; i < kAxisCount; ++i) {
    drives[i] = (0.03 + 0.94 * random.uniform()) * profile.geometry.cylinder[i].stroke_m;
  }
  if (profile.has_swing()) {
    const SwingProfile& swing = profile.swing;
    drives[kSwing] = swing.right_end_rad + 0.05 +
                     random.uniform() * (swing.left_end_rad - swing.right_end_rad - 0.1);
  }
  return drives;
}

class TaskDraw {
 public:
  TaskDraw(const machines::SimulatedExcavator& machine, std::uint64_t seed)
      : machine_(machine),
        profile_(machine.profile),
        kinematics_(profile_.geometry),
        random_(seed, plant::Draw::kFencedTask) {}

  FencedTask run() {
    FencedTask task;
    for (int i = 0; i < kTries; ++i) {
      task.request = draw_steps();
      const ProgramResult open = plan_program(profile_, task.request);
      if (open.refusal == ProgramRefusal::kNone && add_fences(open.program, task)) {
        return task;
      }
    }
    throw std::runtime_error("no random task could be planned on this machine");
  }

 private:
  [[nodiscard]] TeethPose teeth(const DriveVector& drives) const {
    return kinematics_.teeth_from_joints(kinematics_.joints_from_drive(drives).value);
  }

  ProgramRequest draw_steps() {
    ProgramRequest request;
    request.start = teeth(random_drives(profile_, random_));
    request.step_count = 1 + static_cast<int>(3.0 * random_.uniform());
    TeethPose last = request.start;
    for (int i = 0; i < request.step_count; ++i) {
      StepRequest& step = request.step[static_cast<unsigned>(i)];
      step.straight = random_.uniform() < 0.5;
      step.kind = step.straight ? StepKind::kDig : StepKind::kSwing;
      if (step.straight) {
        draw_line(last, step);
      } else {
        last = teeth(random_drives(profile_, random_));
        step.pace_ratio = 0.2 + 0.6 * random_.uniform();
      }
      step.to = last;
    }
    return request;
  }

  void draw_line(TeethPose& last, StepRequest& step) {
    const double ahead_m = random_.symmetric(1.5);
    const double aside_m = profile_.has_swing() ? random_.symmetric(1.5) : 0.0;
    const double swing_rad = std::atan2(last.position_m.y(), last.position_m.x());
    last.position_m += Eigen::Vector3d(
        ahead_m * std::cos(swing_rad) - aside_m * std::sin(swing_rad),
        ahead_m * std::sin(swing_rad) + aside_m * std::cos(swing_rad), random_.symmetric(1.5));
    last.attitude_rad += random_.symmetric(0.5);
    step.speed_mps = 0.1 + 0.6 * random_.uniform();
  }

  /// False where none of what is drawn can be planned, or leaves room for a start.
  bool add_fences(const TaskProgram& open, FencedTask& task) {
    constexpr int kFenceTries = 30;
    look_along(open);
    for (int i = 0; i < kFenceTries; ++i) {
      task.request.fences = draw_fences();
      const ProgramResult planned = plan_program(profile_, task.request);
      if (planned.refusal != ProgramRefusal::kNone) {
        ++task.refused;
      } else if (find_start(planned.program, task)) {
        task.program = planned.program;
        return true;
      }
    }
    return false;
  }

  void look_along(const TaskProgram& program) {
    way_.clear();
    for (int i = 0; i < program.step_count; ++i) {
      for (int k = 0; k <= kLooks; ++k) {
        const TaskStep& step = program.step[static_cast<unsigned>(i)];
        const double share = static_cast<double>(k) / kLooks;
        way_.push_back(truth(step_motion(kinematics_, step, share).value));
      }
    }
  }

  [[nodiscard]] FenceTruth truth(const DriveVector& drives) const {
    return FenceTruth(plant::ExcavatorPlant(
        machine_.plant, {drives[kBoom], drives[kArm], drives[kBucket]}, drives[kSwing]));
  }

  /// Of the way to the fence.
  [[nodiscard]] double left_m(const Fence& fence) const {
    double least_m = 1e3;
    for (const FenceTruth& place : way_) {
      least_m = std::min(least_m, place.left_m(fence));
    }
    return least_m;
  }

  FenceSet draw_fences() {
    FenceSet fences;
    const int count = 1 + static_cast<int>(5.0 * random_.uniform());
    while (fences.count < count) {
      fences.fence[static_cast<unsigned>(fences.count++)] =
          random_.uniform() < 0.5 ? draw_plane() : draw_keep_out();
    }
    return fences;
  }

  /// Beside the way: moved until it is as near as it is to be.
  Fence draw_plane() {
    Fence fence;
    const double kind = random_.uniform();
    if (kind < 0.3) {
      fence.normal = Eigen::Vector3d::UnitZ();
    } else if (kind < 0.6) {
      fence.normal = -Eigen::Vector3d::UnitZ();
    } else {
      const double turn_rad = random_.symmetric(kPi);
      fence.normal = {std::cos(turn_rad), std::sin(turn_rad), 0.0};
    }
    fence.offset_m = -left_m(fence) + kTooNear_m + random_.uniform() * (kNear_m - kTooNear_m);
    return fence;
  }

  Fence draw_keep_out() {
    Fence fence;
    for (int i = 0; i < kTries; ++i) {
      const double out_m = 1.5 + 8.0 * random_.uniform();
      const double turn_rad = random_.symmetric(kPi);
      const double low_m = -3.0 + 6.0 * random_.uniform();
      const double size_m = 0.1 + 1.2 * random_.uniform();
      const double other_m = 0.1 + 1.2 * random_.uniform();
      const double half_height_m = 0.1 + 1.5 * random_.uniform();
      const bool round = random_.uniform() < 0.5;
      const double box_rad = random_.symmetric(kPi);
      fence.shape = round ? FenceShape::kCylinder : FenceShape::kBox;
      fence.normal = {std::cos(box_rad), std::sin(box_rad), 0.0};
      fence.centre_m = {out_m * std::cos(turn_rad), out_m * std::sin(turn_rad),
                        low_m + half_height_m};
      fence.half_m = {size_m, round ? size_m : other_m, half_height_m};
      const double away_m = left_m(fence);
      if (away_m > kTooNear_m && away_m < kNear_m) {
        return fence;
      }
    }
    return fence;
  }

  bool find_start(const TaskProgram& program, FencedTask& task) {
    for (int i = 0; i < kTries; ++i) {
      task.start = random_drives(profile_, random_);
      const FenceTruth place = truth(task.start);
      bool free = true;
      for (int k = 0; free && k < program.fences.count; ++k) {
        free = place.left_m(program.fences.fence[static_cast<unsigned>(k)]) > kFree_m;
      }
      if (free) {
        return true;
      }
    }
    return false;
  }

  const machines::SimulatedExcavator& machine_;
  const ExcavatorProfile& profile_;
  SwingKinematics kinematics_;
  plant::Random random_;
  std::vector<FenceTruth> way_;
};

FenceEnd end_of(const AutodigResult& result) {
  switch (result.end) {
    case AutodigEnd::kDone:
      return FenceEnd::kDone;
    case AutodigEnd::kNotFinished:
      return FenceEnd::kNotFinished;
    case AutodigEnd::kFault:
      break;
  }
  return result.fault == Fault::kNoWay ? FenceEnd::kNoWay : FenceEnd::kFault;
}

}  // namespace

FencedTask draw_fenced_task(const machines::SimulatedExcavator& machine, std::uint64_t seed) {
  return TaskDraw(machine, seed).run();
}

const FigureTable<FenceSummary>& fence_figures() {
  using S = FenceSummary;
  static const FigureTable<S> all = {
      {{"beyond_m", "true machine beyond a fence, max", kMillimetres, "beyond_m"},
       [](const S& s) { return s.beyond_m; }},
      {{"fence_left_m", "distance to the nearest fence, min", kMillimetres, "fence_left_m",
        BadEnd::kLow},
       [](const S& s) { return s.left_m; }},
      {{"refused", "fences that could not be planned against", kCount, "refused"},
       [](const S& s) { return s.refused; }},
      {{"task_s", "time of the steps", kSeconds, "task_s"}, [](const S& s) { return s.task_s; }},
      {{"fault", "fault that stopped it", kCount, "fault"}, [](const S& s) { return s.fault; }},
  };
  return all;
}

FenceResult run_fenced_task(const machines::SimulatedExcavator& machine, std::uint64_t seed) {
  const FencedTask task = draw_fenced_task(machine, seed);
  AutodigOptions options;
  options.start = task.start;
  const AutodigResult run = run_autodig(machine, task.program, options,
                                        [](double /*share*/, const std::string& /*where*/) {});
  const AutodigSummary figures = summarise(task.program, run);
  FenceResult result;
  result.end = end_of(run);
  result.summary.left_m = figures.fence_left_m;
  result.summary.beyond_m = std::max(0.0, -figures.fence_left_m);
  result.summary.refused = task.refused;
  result.summary.task_s = result.end == FenceEnd::kDone ? figures.task_s : kAbsent;
  result.summary.fault = static_cast<double>(run.fault);
  return result;
}

}  // namespace graben::runs
