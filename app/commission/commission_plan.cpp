// SPDX-License-Identifier: Apache-2.0
#include "app/commission/commission_plan.hpp"

#include <fmt/format.h>

namespace graben::commission {
namespace {

constexpr double kUsualMost_mps = 0.5;
/// While the drive is still near the middle.
constexpr int kBurstAfter = 2;

void add_drive(const SequenceOptions& options, int axis, std::vector<SequenceStep>& steps) {
  const auto k = static_cast<unsigned>(axis);
  const Window& window = options.window[k];
  steps.push_back({StepKind::kRamp, axis, 1});
  steps.push_back({StepKind::kRamp, axis, -1});
  for (int level = 0; options.steps && level < kLevelCount; ++level) {
    steps.push_back({StepKind::kStep, axis, 1, level});
    steps.push_back({StepKind::kStep, axis, -1, level});
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
  return steps;
}

const char* axis_name(int axis) {
  constexpr std::array<const char*, kAxisCount> kNames = {"boom", "arm", "bucket"};
  return kNames[static_cast<unsigned>(axis)];
}

std::string step_text(const SequenceStep& step) {
  const std::string where =
      fmt::format("{}, {}", axis_name(step.axis), step.sign > 0 ? "extending" : "retracting");
  switch (step.kind) {
    case StepKind::kRamp:
      return where + ": ramp to its edge";
    case StepKind::kStep:
      return fmt::format("{}: step {} of {}", where, step.level + 1, kLevelCount);
    case StepKind::kBurst:
      return fmt::format("{}: pulses for the lowest mode", axis_name(step.axis));
    case StepKind::kTouch:
      return where + ": gentle touch of the stroke's end";
    case StepKind::kPair:
      return fmt::format("{} and {}, {}: together on one pump", axis_name(step.axis),
                         axis_name(step.other), step.sign > 0 ? "extending" : "retracting");
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
  }
  return "";
}

}  // namespace graben::commission
