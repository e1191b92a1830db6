// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Why touches don't say how the IMUs sit, and what would; each throws std::runtime_error.

#include <Eigen/Core>
#include <cstddef>

#include "app/identify/imus/mounting_fit.hpp"

namespace graben::identify {

/// Before any work: too few touches, no reference, a link that sank during a touch.
void assert_askable(const MountingAsk& ask, std::size_t least_touches);

/// This touch is so far off the point of all others.
[[noreturn]] void refuse_stray(const TouchResult& touch, double off_m);
/// No single touch is at fault.
[[noreturn]] void refuse_scattered(const MountingFit& fit);
/// `weakest`: combination of the turns that is known worst.
[[noreturn]] void refuse_alike(const ExcavatorProfile& profile, const MountingAsk& ask,
                               const MountingFit& fit, const Eigen::Vector3d& weakest);
[[noreturn]] void refuse_far(std::size_t axis, double by_rad);

}  // namespace graben::identify
