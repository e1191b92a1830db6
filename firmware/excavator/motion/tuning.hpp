// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Judgements about motions and their corrections: each was chosen.

namespace graben {

// Motions (motion.cpp)

/// Factor on the swing's correction while the swing is to stand: the platform rings less. [-;
/// chosen: not tried]
inline constexpr double kSwingStandsShare = 0.5;
/// Factor on the path's speed where a load has held a drive of late. [-; chosen: not tried]
inline constexpr double kWaryPace = 0.5;

// Corrections by the oil's law (on_oil.cpp)

/// Distance off the path beyond which the oil's law gives way to the field, which leads back. [m;
/// measured: `sweep.py`: soil's max_error_true_m 65.8; x0.7 69.5, x1.3 64.5]
inline constexpr double kOilFarOff_m = 0.15;
/// Most that is undone of a known error of the flow where the operator is slow, at full speed; less
/// with his override. [m/s; chosen: it may be 80 mm/s, more than a slow path; not tried]
inline constexpr double kOilKnownFlow_mps = 0.3;
/// Way of the teeth over a stroke below which a direction is left alone: it damps the least squares
/// where the teeth are in line with both pins. [-; measured: `sweep.py`: soil's max_error_true_m
/// 65.8; x0.7 68.7, x1.3 64]
inline constexpr double kOilInLine = 0.1;

}  // namespace graben
