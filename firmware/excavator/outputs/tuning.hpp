// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Judgements about the swash on demand (pump_demand.cpp): each was chosen.

namespace graben {

/// Reserve of force that the pumps are asked for, as a share of the load. [-; measured: soil's push
/// changes by about so much of itself within a second; `sweep.py`: soil's tip_jerk_rms_mps3 358;
/// x0.7 339, x1.3 326]
inline constexpr double kPumpLoadShare = 0.6;
/// Share of the relief's pressure up to which pressure is asked for: what is beyond goes through
/// the relief. [-; measured: `sweep.py`: soil's max_error_true_m 65.8; x0.7 69.3, x1.3 69.7]
inline constexpr double kPumpReliefShare = 0.95;
/// Rate at which the swash rises, or gives way to a blocked drive, in full swash. [1/s; measured:
/// as fast as a load grows; 3 was tried; `sweep.py`: soil's tip_jerk_rms_mps3 358; x0.7 350, x1.3
/// 332]
inline constexpr double kSwashUp_ps = 1.0;
/// Rate at which the swash falls. [1/s; measured: slow, as the load comes back; `sweep.py`: dry's
/// tip_jerk_rms_mps3 13.5; x0.7 14.3, x1.3 13.9]
inline constexpr double kSwashDown_ps = 0.1;

}  // namespace graben
