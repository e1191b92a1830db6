// SPDX-License-Identifier: Apache-2.0
#pragma once
/// From what was found to the profile that a controller reads.

#include "app/identify/machine/estimate.hpp"
#include "firmware/excavator/excavator_profile.hpp"

namespace graben::identify {

/// Share of a change of speed that hoses and oil add to a drive's lag behind its spool, s; as the
/// shipped profiles have it.
inline constexpr double kOilLag_s = 0.013;

/// The profile with every value that is known; the others stay. Control is tuned to the times that
/// were found, and `safety.settle` allows for them.
[[nodiscard]] ExcavatorProfile identified(const ExcavatorProfile& profile,
                                          const MachineEstimate& machine);

}  // namespace graben::identify
