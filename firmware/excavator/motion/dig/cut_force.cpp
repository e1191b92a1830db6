// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/dig/cut_force.hpp"

#include <algorithm>

#include "firmware/excavator/motion/dig/tuning.hpp"

namespace graben {
namespace {}  // namespace

double force_share(const LayerPlan& plan, const TeethLine& line, const CutSeen& seen, bool enters) {
  if (!seen.force_known || !(plan.force_n > 0.0)) {
    return 0.0;
  }
  const Eigen::Vector3d& change_m = line.change.position_m;
  const double level_m = change_m.head<2>().norm();
  // The line leads to the machine: inwards in the plane of the links.
  const Eigen::Vector2d inwards = Eigen::Vector2d(-level_m, change_m.z()).normalized();
  const double against_n = enters ? seen.force_n.y() : -seen.force_n.dot(inwards);
  return std::max(0.0, against_n) / plan.force_n;
}

double off_foot_m(const LayerPlan& plan, const Cut& cut, const CutSeen& seen) {
  return cut.from_share < 0.0 && seen.force_known
             ? plan.give_down_mpn * std::max(0.0, seen.force_n.y())
             : 0.0;
}

double heaviness(const LayerPlan& plan, double force, const CutSeen& seen) {
  const double held = seen.lambda < kStandsAt ? kHoldsAt : 0.0;
  return std::max({force, seen.behind_m / (kBehind_share * plan.bucket_m), held});
}

}  // namespace graben
