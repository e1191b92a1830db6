// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Judgement about what the status says (status.cpp): it was chosen.

namespace graben {

/// Distance straight ahead from which teeth are looked at where there is no mark: a turn of the
/// platform shows there. [m; size: beyond the teeth]
inline constexpr double kNoMark_m = 20.0;

/// Pace of a plan, as a share of its own, below which it waits. [-; chosen: not tried]
inline constexpr double kPlanWaitsPace = 0.5;

}  // namespace graben
