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

// More than the model asks for, where a drive falls short.

/// Share of its wanted speed that a drive lacks, from which it counts. [-; measured: `campaign dig
/// --soil --speed 0.1 --profile excavator_12t --draws 8`: 83 / 114 mm, without it 145 / 270; 0.3 82
/// / 149, and dry the pumps put in a third more; 0.45 82 / 138, 0.6 123 / 199]
inline constexpr double kShortFrom = 0.4;
/// Rise of the swash where it lacks all beyond that, in full swash. [1/s; measured: `campaign dig
/// --soil --draws 100`, 22 t: 55 / 82 mm, without it 60 / 90; twice both rates: no better in 24]
inline constexpr double kShortUp_ps = 1.0;
/// Its fall. [1/s; measured: `campaign dig --draws 24`: half of it leaves the swash up on a dry
/// path, the largest error 47 mm where this has 34]
inline constexpr double kShortDown_ps = 0.1;
/// Most of it. [-; measured: `campaign dig --soil --speed 0.3 --draws 24`: with 0.6 one machine of
/// 22 t is stopped]
inline constexpr double kShortMost = 0.35;
/// Speed at which a wanted one counts half. [m/s; chosen: about a stroke sensor's noise; not tried]
inline constexpr double kShortHalf_mps = 0.002;

}  // namespace graben
