// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Judgement about what the status says (status.cpp): it was chosen.

namespace graben {

/// Pace of a plan, as a share of its own, below which it waits. [-; chosen: not tried]
inline constexpr double kPlanWaitsPace = 0.5;

}  // namespace graben
