// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Second sensors of joints, watched against what the controller goes by.

#include <array>

#include "firmware/excavator/safety/excavator_validation.hpp"
#include "firmware/safety/witness.hpp"

namespace graben {

using SecondStates = std::array<WitnessState, kDriveCount>;

/// In every mode, of every joint that has a second sensor: kWitnessDisagrees where it contradicts
/// the first one, which stops; kWitnessMissing where it is not there, valid and in time. In motion
/// that slows; at rest it keeps from arming, unless the profile allows to work without it. A first
/// sensor that is lost is the validation's to find.
void watch_seconds(const ExcavatorProfile& profile, DriveRows drives, const ExcavatorInputs& inputs,
                   bool moving, TimeUs now_us, SecondStates& states, ExcavatorValid& valid);

}  // namespace graben
