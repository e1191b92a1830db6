// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/estimation/load/load_balance.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/core/time.hpp"
#include "firmware/excavator/estimation/load/tuning.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben {
namespace {

/// A cycle that comes late is passed in parts, in which the low-pass is stable.
void pass(const Eigen::Vector3d& seen, double elapsed_s, bool restart, PairedFilter& filter) {
  if (restart) {
    begin(seen, filter);
    return;
  }
  const int parts = cycles_in(elapsed_s);
  for (int n = 0; n < parts; ++n) {
    advance(seen, elapsed_s / parts, filter);
  }
}

}  // namespace

void next_balance(const ExcavatorProfile& profile, const LoadSeen& seen, double elapsed_s,
                  bool restart, BalanceFilter& filter, LoadBalance& balance) {
  const LinkPlaces at = link_places(profile.oil, profile.geometry, seen.joints_rad);
  const Eigen::Vector3d per_lever = seen.lever_m.cwiseInverse();
  const LinkMoments holding = holding_moments(profile.oil, at);
  const Eigen::Vector3d at_rest_n =
      seen.force_n - per_lever.cwiseProduct(holding.of_link.rowwise().sum());
  pass(at_rest_n, elapsed_s, restart, filter.force_n);
  pass(per_lever.cwiseProduct(holding.load_nmpkg), elapsed_s, restart, filter.load_npkg);
  pass(seen.stroke_m, elapsed_s, restart, filter.stroke_m);
  balance.speed_mps = filter.stroke_m.rate_ps;

  // How the levers change takes no share: squares of the joints' rates are small.
  const Eigen::Vector3d rates_radps = per_lever.cwiseProduct(filter.stroke_m.rate_ps);
  const Eigen::Vector3d turns_radps2 = per_lever.cwiseProduct(filter.stroke_m.change_ps2);
  const LinkMoments moving = moving_moments(profile.oil, at, rates_radps, turns_radps2,
                                            seen.swing_radps, profile.geometry.boom_foot_m.x());
  balance.force_n = filter.force_n.value - per_lever.cwiseProduct(moving.of_link.rowwise().sum());
  balance.teeth = per_lever.asDiagonal() * teeth_moments_m(at);
  for (int axis = 0; axis < kAxisCount; ++axis) {
    const double side = std::clamp(balance.speed_mps[axis] / kFrictionMoves_mps, -1.0, 1.0);
    TermRow& row = balance.row[static_cast<unsigned>(axis)];
    row.share = {1.0,
                 side,
                 balance.speed_mps[axis] *
                     (1.0 + std::abs(balance.speed_mps[axis]) /
                                hoses_mps(profile.geometry.cylinder[static_cast<unsigned>(axis)])),
                 0.0,
                 0.0,
                 0.0,
                 filter.load_npkg.value[axis] + per_lever[axis] * moving.load_nmpkg[axis],
                 per_lever[axis] * kStandardGravity_mps2};
    for (int link = axis; link < kAxisCount; ++link) {
      row.share[3U + static_cast<unsigned>(link)] =
          per_lever[axis] * (holding.of_link(axis, link) + moving.of_link(axis, link));
    }
  }
}

}  // namespace graben
