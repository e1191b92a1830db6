// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How heavy a cut is, by the tip's force, by how far the teeth are behind and by lambda.

#include "firmware/excavator/motion/dig/dig_cycle.hpp"

namespace graben {

/// The force on the teeth against the edge's motion, of that which a cut gives way to: along the
/// line, or upwards while the edge `enters`. 0 where no force is known.
[[nodiscard]] double force_share(const LayerPlan& plan, const TeethLine& line, const CutSeen& seen,
                                 bool enters);

/// What the teeth sink by, m, once the heel is off the foot of the wall that it stands on: of a cut
/// that begins beyond its line.
[[nodiscard]] double off_foot_m(const LayerPlan& plan, const Cut& cut, const CutSeen& seen);

/// 1: as heavy as a cut may be. `force`: by force_share().
[[nodiscard]] double heaviness(const LayerPlan& plan, double force, const CutSeen& seen);

}  // namespace graben
