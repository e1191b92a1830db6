// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Duties that are tried while a machine is commissioned, on valves of which nothing is known.

#include "firmware/excavator/inputs/inputs.hpp"

namespace graben {

/// Guards them, and gives those that may be sent in `state.tried_ratio`; what holds them back is in
/// `state.commission`. What a drive does wrong stops, where nothing else does.
void guard_tried_duties(DriveRows drives, const Cycle& cycle, const LastCommands<kDriveCount>& last,
                        ExcavatorValid& valid, InputState& state);

/// Of the first cylinder that its window holds back.
[[nodiscard]] Limit tried_limit(DriveRows drives,
                                const std::array<CommissionState, kDriveCount>& commission);

}  // namespace graben
