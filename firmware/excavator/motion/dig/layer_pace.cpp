// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/dig/layer_run.hpp"

#include <algorithm>

#include "firmware/excavator/motion/dig/layer_height.hpp"

namespace graben {
namespace {

/// A plan slows down so much faster than it gets on again.
constexpr double kSlowsFaster = 4.0;
/// Teeth that sink under a last cut count so much more than teeth that are late.
constexpr double kSinks = 2.5;
/// Of their height over the design, that teeth may be behind.
constexpr double kOffOfHeight = 0.15;

double behind_m(const TaskProgram& program, const CutSeen& seen, const TaskState& state) {
  const LayerState& layers = state.layers;
  if (layers.phase != CutPhase::kCuts || !layers.cuts.cut.thin) {
    return seen.behind_m;
  }
  const double sunk_m = layers.height_m - seen_height_m(program, seen, state);
  return std::max(seen.behind_m, kSinks * sunk_m);
}

/// So far behind it goes half as fast.
double slow_m(const LineProfile& line, const TaskProgram& program, const CutSeen& seen,
              const TaskState& state) {
  if (state.layers.phase == CutPhase::kNone) {
    return line.move_slow_error_m;
  }
  const double over_m = std::min(state.layers.height_m, seen_height_m(program, seen, state));
  return std::max(line.slow_error_m + line.slow_error_s * program.layers.speed_mps,
                  std::min(kOffOfHeight * over_m, line.move_slow_error_m));
}

}  // namespace

void follow_pace(const LineProfile& line, const TaskProgram& program, const CutSeen& seen,
                 double period_s, TaskState& state) {
  const double off = behind_m(program, seen, state) / slow_m(line, program, seen, state);
  const double slowed = 1.0 / (1.0 + off * off);
  const double change = line.pace_rate_ps * period_s;
  state.pace_ratio =
      std::clamp(slowed > 0.0 ? slowed : 0.0, state.pace_ratio - kSlowsFaster * change,
                 state.pace_ratio + change);
}

}  // namespace graben
