// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the implement's pump truly gives, of what its model says.

#include <array>

#include "firmware/dozer/blade.hpp"

namespace graben {

/// State from cycle to cycle.
struct FlowShareState {
  double share = 0.97;    ///< What the pump has been seen to give, or not to give.
  double fast_s = 0.0;    ///< For so long the blade has been raised with nearly all the flow;
  double due_m3 = 0.0;    ///< of late its valves should have let through so much in that time,
  double taken_m3 = 0.0;  ///< and its cylinders took so much.
  std::array<double, kBladeCount> stroke_m{};  ///< Of the last cycle.
};

/// Lift and tilt.
struct FlowSituation {
  std::array<double, kBladeCount> due_mps{};   ///< What they should do, by what was asked of them.
  std::array<double, kBladeCount> stroke_m{};  ///< Measured now.
  double engine_radps = 0.0;                   ///< 0 where nothing was commanded.
};

/// A cycle on. While the blade is raised with most of what there is, the oil that it takes is
/// compared with what its valves should let through: where it is clearly less, the pump gives no
/// more, and Q / Q_model of (11) is followed with a low-pass, within kFlowShareLeast and 1. What it
/// has given it can give. A worn pump gives less than its profile says; where more of it is planned
/// with, the body tips over a crest faster than the blade can be raised. Downwards the ground may
/// hold it: nothing is learnt.
[[nodiscard]] FlowShareState next_flow_share(const DozerProfile& profile,
                                             const FlowShareState& last, const FlowSituation& now,
                                             double period_s);

}  // namespace graben
