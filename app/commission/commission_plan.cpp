// SPDX-License-Identifier: Apache-2.0
#include "app/commission/commission_plan.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/machines/axis_names.hpp"
#include "firmware/excavator/kinematics/excavator_kinematics.hpp"

namespace graben::commission {
namespace {

constexpr double kUsualMost_mps = 0.5;
/// While the drive is still near the middle.
constexpr int kBurstAfter = 2;

constexpr double kSector_rad = 30.0 * M_PI / 180.0;
/// Over the ground, of the teeth, while the platform turns.
constexpr double kClear_m = 1.5;
/// Places of each stroke that are looked at, away from its ends.
constexpr int kPlaces = 9;

/// Of what the pump's relief would give a platform that is as heavy as the profile says.
constexpr double kBrakes = 0.5;

double braking_radps2(const ExcavatorProfile& profile) {
  const SwingProfile& swing = profile.swing;
  const double torque_nm = swing.displacement_m3prad * profile.pump[0].relief_pa;
  return swing.inertia_kgm2 > 0.0 ? torque_nm / swing.inertia_kgm2 : 0.0;
}

double place_m(const Window& window, int place) {
  constexpr double kEndShare = 0.1;
  const double share = kEndShare + (1.0 - 2.0 * kEndShare) * place / (kPlaces - 1);
  return window.least_m + share * (window.most_m - window.least_m);
}

/// What reaches least with the bucket clear of the ground; the middle of the windows where nothing
/// does.
std::array<double, kAxisCount> folded_m(const ExcavatorProfile& profile,
                                        const SequenceOptions& options) {
  const ExcavatorKinematics kinematics(profile.geometry);
  std::array<double, kAxisCount> best{};
  for (unsigned k = 0; k < kAxisCount; ++k) {
    best[k] = 0.5 * (options.window[k].least_m + options.window[k].most_m);
  }
  double least_m = 1e9;
  for (int boom = 0; boom < kPlaces; ++boom) {
    for (int arm = 0; arm < kPlaces; ++arm) {
      const Eigen::Vector3d strokes_m(place_m(options.window[kBoom], boom),
                                      place_m(options.window[kArm], arm), best[kBucket]);
      const KinematicState at = kinematics.state(strokes_m);
      const bool clear = at.tip.y_m + profile.geometry.boom_foot_m.y() > kClear_m;
      if (at.status == ReachStatus::kOk && clear && std::abs(at.tip.x_m) < least_m) {
        least_m = std::abs(at.tip.x_m);
        best = {strokes_m[kBoom], strokes_m[kArm], strokes_m[kBucket]};
      }
    }
  }
  return best;
}

void add_swing(const SequenceOptions& options, std::vector<SequenceStep>& steps) {
  const auto both = [&steps](StepKind kind, int level) {
    steps.push_back({kind, kSwing, 1, level});
    steps.push_back({kind, kSwing, -1, level});
  };
  steps.push_back({StepKind::kFold, kSwing, 0});
  both(StepKind::kRamp, 0);
  for (int level = 0; options.steps && level < kSwingLevelCount; ++level) {
    both(StepKind::kStep, level);
  }
}

void add_drive(const SequenceOptions& options, int axis, std::vector<SequenceStep>& steps) {
  const auto k = static_cast<unsigned>(axis);
  const Window& window = options.window[k];
  const int first = options.first_sign[k];
  steps.push_back({StepKind::kRamp, axis, first});
  steps.push_back({StepKind::kRamp, axis, -first});
  for (int level = 0; options.steps && level < kLevelCount; ++level) {
    steps.push_back({StepKind::kStep, axis, first, level});
    steps.push_back({StepKind::kStep, axis, -first, level});
    if (options.bursts && level == kBurstAfter) {
      steps.push_back({StepKind::kBurst, axis, 1});
    }
  }
  if (options.touch_retracted[k] && window.least_m <= kEnd_m) {
    steps.push_back({StepKind::kTouch, axis, -1});
  }
  if (options.touch_extended[k] && window.most_m >= options.stroke_m[k] - kEnd_m) {
    steps.push_back({StepKind::kTouch, axis, 1});
  }
}

}  // namespace

SequenceOptions whole_sequence(const ExcavatorProfile& profile) {
  SequenceOptions options;
  for (unsigned k = 0; k < kAxisCount; ++k) {
    options.stroke_m[k] = profile.geometry.cylinder[k].stroke_m;
    options.window[k] = {0.0, options.stroke_m[k], kUsualMost_mps};
    options.pump[k] = profile.valve.spool[k].pump;
  }
  options.has_swing = profile.has_swing();
  options.swing = options.has_swing;
  if (options.has_swing) {
    // Half of it stays free where the platform's own range is small.
    const SwingProfile& swing = profile.swing;
    options.sector.right_rad = std::max(-kSector_rad, 0.5 * swing.right_end_rad);
    options.sector.left_rad = std::min(kSector_rad, 0.5 * swing.left_end_rad);
    options.brakes_radps2 =
        std::max(swing.acceleration_max_radps2, kBrakes * braking_radps2(profile));
    options.folded_m = folded_m(profile, options);
  }
  return options;
}

std::vector<SequenceStep> planned_steps(const SequenceOptions& options) {
  std::vector<SequenceStep> steps;
  for (int axis = 0; axis < kAxisCount; ++axis) {
    if (options.drives[static_cast<unsigned>(axis)]) {
      add_drive(options, axis, steps);
    }
  }
  for (int axis = 0; options.pairs && axis < kAxisCount; ++axis) {
    for (int other = axis + 1; other < kAxisCount; ++other) {
      const auto k = static_cast<unsigned>(axis);
      const auto n = static_cast<unsigned>(other);
      if (options.drives[k] && options.drives[n] && options.pump[k] == options.pump[n]) {
        // A line that feeds a light drive lets a heavy one's load in: not against both loads.
        steps.push_back({StepKind::kPair, axis, -1, 0, other});
      }
    }
  }
  if (options.swing) {
    add_swing(options, steps);
  }
  return steps;
}

const char* axis_name(int axis) { return machines::kDriveNames[static_cast<unsigned>(axis)]; }

std::string step_text(const SequenceStep& step) {
  const bool turns = step.axis == kSwing;
  const char* const way =
      step.sign > 0 ? (turns ? "left" : "extending") : (turns ? "right" : "retracting");
  const std::string where = fmt::format("{}, {}", axis_name(step.axis), way);
  switch (step.kind) {
    case StepKind::kRamp:
      return where + ": ramp to its edge";
    case StepKind::kStep:
      return fmt::format("{}: step {} of {}", where, step.level + 1,
                         turns ? kSwingLevelCount : kLevelCount);
    case StepKind::kBurst:
      return fmt::format("{}: pulses for the lowest mode", axis_name(step.axis));
    case StepKind::kTouch:
      return where + ": gentle touch of the stroke's end";
    case StepKind::kPair:
      return fmt::format("{} and {}, {}: together on one pump", axis_name(step.axis),
                         axis_name(step.other), step.sign > 0 ? "extending" : "retracting");
    case StepKind::kFold:
      return "swing: arm in, bucket off the ground";
  }
  return where;
}

const char* end_text(StepEnd end) {
  switch (end) {
    case StepEnd::kDone:
      return "done";
    case StepEnd::kAtWindow:
      return "at window";
    case StepEnd::kNoMotion:
      return "no motion";
    case StepEnd::kOutside:
      return "outside";
    case StepEnd::kNoTime:
      return "no time";
  }
  return "";
}

std::string speed_text(const SequenceStep& step, const StepResult& result) {
  return step.axis == kSwing ? fmt::format("{:.2f} rad/s", result.speed_mps)
                             : fmt::format("{:.0f} mm/s", 1e3 * result.speed_mps);
}

}  // namespace graben::commission
