// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/flow_share.hpp"

#include <algorithm>

#include "firmware/dozer/tuning.hpp"

namespace graben {
namespace {

/// What lift and tilt take in with these velocities, or ways.
double inflow(const DozerProfile& profile, const std::array<double, kBladeCount>& of) {
  return inflow_m3ps(profile.blade, of[kBladeLift]) + inflow_m3ps(profile.tilt, of[kBladeTilt]);
}

double counted(double last_m3, double now_m3, double period_s) {
  return (last_m3 + now_m3) * kFlowShareCounted_s / (kFlowShareCounted_s + period_s);
}

/// Up to what is given; down to it only where the pump lacks it.
double drawn(double last, double given, double newest, bool lacks) {
  const double moved = last + (given - last) * newest;
  return std::clamp(lacks ? moved : std::max(last, moved), kFlowShareLeast, 1.0);
}

}  // namespace

FlowShareState next_flow_share(const DozerProfile& profile, const FlowShareState& last,
                               const FlowSituation& now, double period_s) {
  const double modelled_m3ps = available_flow_m3ps(profile.implement, now.engine_radps);
  const double due_m3ps = inflow(profile, now.due_mps);
  FlowShareState state{last.share, 0.0, 0.0, 0.0, now.stroke_m};
  if (now.due_mps[kBladeLift] >= 0.0 || !(modelled_m3ps * period_s > 0.0) ||
      due_m3ps < kFlowShareFast * modelled_m3ps) {
    return state;
  }
  const double taken_m3 = inflow(profile, {now.stroke_m[kBladeLift] - last.stroke_m[kBladeLift],
                                           now.stroke_m[kBladeTilt] - last.stroke_m[kBladeTilt]});
  state.fast_s = std::min(last.fast_s + period_s, kFlowShareCounted_s);
  state.due_m3 = counted(last.due_m3, due_m3ps * period_s, period_s);
  state.taken_m3 = counted(last.taken_m3, taken_m3, period_s);
  if (state.fast_s >= kFlowShareWarm_s && state.due_m3 > 0.0) {
    const double given = due_m3ps / modelled_m3ps * state.taken_m3 / state.due_m3;
    const double newest = period_s / (kFlowShareLearn_s + period_s);
    const bool lacks = state.taken_m3 < kFlowShareComes * state.due_m3;
    state.share = drawn(last.share, given, newest, lacks);
  }
  return state;
}

}  // namespace graben
