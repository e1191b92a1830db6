// SPDX-License-Identifier: Apache-2.0
#pragma once
/// From what was found to the profile that a controller reads.

#include "app/identify/machine/estimate.hpp"
#include "firmware/excavator/excavator_profile.hpp"

namespace graben::identify {

/// Full areas of one side's metering edges, m^2.
struct SideAreas {
  double in_m2 = 0.0;
  double out_m2 = 0.0;
};

/// Those of a side whose velocity coefficient and draining area were found: the in-flow edge's is
/// what (9), (11) leave for it.
[[nodiscard]] SideAreas areas_of(const ExcavatorProfile& profile, int axis, bool extends,
                                 const SideEstimate& side);

/// Share of a change of speed that hoses and oil add to a drive's lag behind its spool, s; as the
/// shipped profiles have it.
inline constexpr double kOilLag_s = 0.013;

/// The profile with every value that is known; the others stay. Control is tuned to the times that
/// were found, and `safety.settle` allows for them.
[[nodiscard]] ExcavatorProfile identified(const ExcavatorProfile& profile,
                                          const MachineEstimate& machine);

}  // namespace graben::identify
