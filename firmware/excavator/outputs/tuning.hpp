// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Judgements about the swash on demand (pump_demand.cpp): each was chosen.

namespace graben {

/// Reserve of force that the pumps are asked for, as a share of the load. [-; chosen: soil's push
/// changes by about so much of itself within a second; not tried]
inline constexpr double kPumpLoadShare = 0.6;
/// Share of the relief's pressure up to which pressure is asked for: what is beyond goes through
/// the relief. [-; chosen: not tried]
inline constexpr double kPumpReliefShare = 0.95;
/// Rate at which the swash rises, or gives way to a blocked drive, in full swash. [1/s; chosen: as
/// fast as a load grows; 3 was tried]
inline constexpr double kSwashUp_ps = 1.0;
/// Rate at which the swash falls. [1/s; chosen: slow, as the load comes back; not tried]
inline constexpr double kSwashDown_ps = 0.1;

}  // namespace graben
