// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The machine as the stages of a cycle know it: views of what ExcavatorSetup holds.

#include "firmware/excavator/excavator_drives.hpp"
#include "firmware/excavator/kinematics/swing_kinematics.hpp"

namespace graben {

struct ExcavatorModel {
  const ExcavatorProfile& profile;
  DriveRows drives = {nullptr, 0};
  const SwingKinematics& kinematics;
  const McvMachine& valve;
};

}  // namespace graben
