// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Measured joint angles as the strokes that they stand for.

#include <array>

#include "firmware/excavator/excavator_signals.hpp"
#include "firmware/excavator/kinematics/excavator_kinematics.hpp"
#include "firmware/signals/signal.hpp"

namespace graben {

/// As valid and as old as the worst of the joints: each is kept, or none. A joint beyond the end of
/// its cylinder by no more than kBeyondEnd_m is at that end; farther, or where its linkage cannot
/// be, all are kOutOfRange.
[[nodiscard]] std::array<Signal<double>, kAxisCount> strokes_of_joints(
    const ExcavatorKinematics& kinematics,
    const std::array<Signal<double>, kAxisCount>& joints_rad);

}  // namespace graben
