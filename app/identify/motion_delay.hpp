// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a fitted joint's parameters come to, for whoever reads them.

#include <array>

#include "app/identify/motion_model.hpp"

namespace graben::identify {

/// From a step of the command, s; not a number where that direction was not driven.
struct TotalDelay {
  double half_s = 0.0;  ///< To 50 % of the speed,
  double most_s = 0.0;  ///< and to 90 %.
};

/// Of the joint alone at its usual pose, its velocity behind a step to `command`, which is -1 .. 1.
[[nodiscard]] TotalDelay total_delay(const JointModel& joint, double command);

/// The value lies where it may go no farther: what it would be is not known, nor how surely.
[[nodiscard]] bool at_bound(const JointModel& joint, std::size_t parameter, double usual_radps);

}  // namespace graben::identify
