// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Load on the blade: how much the ground takes, and how far the blade has to rise for it.

#include "firmware/dozer/safety/dozer_validation.hpp"

namespace graben {

/// State from cycle to cycle.
struct PushState {
  double push_n = 0.0;      ///< Of the tracks against what holds the blade, low-passed.
  double rising_nps = 0.0;  ///< As far as it rises, low-passed.
  double slip = 0.0;        ///< Of the tracks, low-passed.
  double lift_m = 0.0;      ///< Of the edge over the design.
  double rate_mps = 0.0;    ///< How that changes.
};

/// What both tracks give the ground, either way, by the pressures of their lines; 0 where nobody
/// tells these.
[[nodiscard]] double traction_n(const DozerProfile& profile, const DozerValid& valid);

/// What both tracks drive the body with, N, by the pressures of their lines, less what the slope
/// takes. Lines whose pressure nobody knows push with nothing.
[[nodiscard]] double push_n(const DozerProfile& profile, const DozerValid& valid);

/// (v_t - v) / v_t of the faster track going forward; less where it hardly moves.
[[nodiscard]] double slip_of(const DozerValid& valid);

/// Of the available flow, that the ground ahead is planned with. A load on the blade tips the body
/// as no preview knows: from kLoadReserveFrom of `push_max_n` on a reserve is kept, in full at
/// twice that.
[[nodiscard]] double planned_share(const TravelProfile& travel, const PushState& load);

/// A cycle on. Above `push_max_n`, or a slip with which the tracks dig themselves in, the blade
/// rises, in proportion to what is too much; below it comes down again, slower. What stays above
/// the design is for another pass.
[[nodiscard]] PushState next_load(const DozerProfile& profile, const PushState& last,
                                  const DozerValid& valid, double period_s);

}  // namespace graben
