// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the stages of a dozer's cycle share: the machine, and what the last cycle left to this one.

#include "firmware/dozer/blade.hpp"
#include "firmware/dozer/safety/dozer_watch.hpp"
#include "firmware/dozer/tilt.hpp"
#include "firmware/safety/mark_check.hpp"
#include "firmware/safety/stall_watch.hpp"
#include "firmware/safety/tube.hpp"

namespace graben {

/// Views of what DozerSetup holds.
struct DozerModel {
  const DozerProfile& profile;
  DriveRows drives = {nullptr, 0};
  const BladeKinematics& blade;
  const TiltKinematics& tilt;
  const GradeProfile& design;  ///< As it is to be in the end, without a pass's floor.

  /// Of the edge ahead of the body's origin, level on the track.
  [[nodiscard]] double reach_m() const { return blade.edge_m(0.0).x(); }
};

/// What Task::kCommission sends as it is asked for it, on drives of which nothing is known.
struct TriedCommand {
  bool tries = false;  ///< The task is followed; else nothing here counts.
  std::array<double, kBladeCount> duty_ratio{};
  double pump_ratio = 0.0;  ///< Of both tracks.
  double motor_ratio = 1.0;
  Limit limit;  ///< Of the first drive that its window holds back.
};

/// What a cycle commanded, and how that was followed. Written once, at its end.
struct DozerLastCycle {
  DozerLastCommands commands;
  std::array<double, kBladeCount> asked_mps{};  ///< Of lift and tilt, as far as the flow goes.
  bool fed = true;                              ///< The pump gives what both ask for.
  StallState stall;
  TubeState tube;       ///< Around the design.
  TubeState off_track;  ///< Around a track that curves.
  MarkState mark;
};

}  // namespace graben
