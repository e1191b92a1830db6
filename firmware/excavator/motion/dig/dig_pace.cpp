// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/dig/dig_run.hpp"

#include <algorithm>

#include "firmware/excavator/motion/dig/layer_height.hpp"
#include "firmware/excavator/motion/dig/layer_pose.hpp"
#include "firmware/excavator/motion/dig/tuning.hpp"

namespace graben {
namespace {

double behind_m(const DigCycle& cycle, const TaskState& state) {
  const double behind_m = cycle.seen.behind_m;
  if (state.dig.phase != CutPhase::kCuts || !state.dug.cuts.cut.thin) {
    return behind_m;
  }
  const double sunk_m = state.dig.height_m - seen_height_m(cycle.program, cycle.seen, state);
  return std::max(behind_m, kSinksShare * sunk_m);
}

/// So far behind it goes half as fast.
double slow_m(const DigCycle& cycle, const TaskState& state) {
  const LineProfile& line = cycle.profile.line;
  if (!at_cut(cycle.program, state)) {
    return line.move_slow_error_m;
  }
  const double over_m =
      std::min(state.dig.height_m, seen_height_m(cycle.program, cycle.seen, state));
  return std::max(line.slow_error_m + line.slow_error_s * cycle.plan().speed_mps,
                  std::min(kOffOfHeight * over_m, line.move_slow_error_m));
}

}  // namespace

void follow_pace(const DigCycle& cycle, TaskState& state) {
  const double off = behind_m(cycle, state) / slow_m(cycle, state);
  const double slowed = 1.0 / (1.0 + off * off);
  const double change = cycle.profile.line.pace_rate_ps * cycle.period_s;
  state.pace_ratio =
      std::clamp(slowed > 0.0 ? slowed : 0.0, state.pace_ratio - kSlowsFaster * change,
                 state.pace_ratio + change);
}

}  // namespace graben
