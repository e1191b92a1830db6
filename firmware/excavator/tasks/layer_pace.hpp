// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How fast a plan in layers goes on while the teeth are behind it.

#include <algorithm>

#include "firmware/excavator/tasks/task_run.hpp"

namespace graben {

/// A plan slows down so much faster than it gets on again.
inline constexpr double kSlowsFaster = 4.0;

/// At `slow_m` behind it goes half as fast, at twice that a fifth.
inline void follow_pace(const LineProfile& line, double slow_m, double behind_m, double period_s,
                        TaskState& state) {
  const double off = behind_m / slow_m;
  const double slowed = 1.0 / (1.0 + off * off);
  const double change = line.pace_rate_ps * period_s;
  state.pace_ratio =
      std::clamp(slowed > 0.0 ? slowed : 0.0, state.pace_ratio - kSlowsFaster * change,
                 state.pace_ratio + change);
}

}  // namespace graben
