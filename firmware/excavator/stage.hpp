// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the stages of an excavator's cycle share: the machine, and what the last cycle left to this
/// one.

#include "firmware/drives/drive_watch.hpp"
#include "firmware/excavator/excavator_drives.hpp"
#include "firmware/excavator/excavator_profile.hpp"
#include "firmware/excavator/fences/site_frame.hpp"
#include "firmware/excavator/kinematics/swing_kinematics.hpp"
#include "firmware/safety/mark_check.hpp"
#include "firmware/safety/stall_watch.hpp"
#include "firmware/safety/tube.hpp"

namespace graben {

/// Views of what ExcavatorSetup holds.
struct ExcavatorModel {
  const ExcavatorProfile& profile;
  DriveRows drives = {nullptr, 0};
  const SwingKinematics& kinematics;
  const McvMachine& valve;
};

/// The valve's flow as the last cycle solved it.
struct LastFlow {
  double lambda = 0.0;        ///< Of the path, without corrections; 0 out of motion.
  double of_corrected = 1.0;  ///< Share of that, with corrections (Followed).
  PerPump<double> line_pa{};  ///< Pressure of each pump's line.
  /// How much less flow boom and arm get for each newton more; 0 of a line that does not give way.
  Eigen::Vector2d yield_mpsn = Eigen::Vector2d::Zero();
};

/// What a cycle commanded, and how that was followed. Written once, at its end.
struct LastCycle {
  LastCommands<kDriveCount> commands;
  std::array<double, kPumpCount> swash_ratio{};
  LastFlow flow;
  /// lambda V_L^d, without corrections: what the servos expect of the drives.
  DriveVector expected_mps = DriveVector::Zero();
  double swing_wanted_mps = 0.0;  ///< V_L^d of a program's swing.
  bool jogs = false;              ///< Drives that are not told to move are nobody's.
  StallState stall;
  TubeState tube;
  MarkState mark;
  SiteState site;
};

}  // namespace graben
