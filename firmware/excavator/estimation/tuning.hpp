// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Numbers that were chosen for the excavator's estimates, each with why. Those of its loads and of
/// its oil are in `load` and `oil`.

namespace graben {

/// Share of a cycle's payload at rest that goes into the weighed one. [-; measured: half a second
/// of low-pass; `sweep.py`: soil's max_error_true_m 65.8; x0.7 61.9, x1.3 69.3]
inline constexpr double kPayloadWeight = 0.02;

/// Force on the teeth, of the weight of boom, arm and bucket, below which they count as free.
/// [-; measured: `dig --errors all`: 0.17 at most in the air; with `--soil` 0.5 and more]
inline constexpr double kFreeTip = 0.3;
/// Time since something has pushed them after which what rings is the oil's. [s; chosen: pauses of
/// a cut are shorter; not tried]
inline constexpr double kFreeAfter_s = 10.0;
/// Time since a motion began after which it is. [s; measured: `campaign dig --errors all --draws
/// 40`: 40 mm at most, with 3 s too; with 0.6 s 82, with none 44 and soil 92 instead of 77]
inline constexpr double kFreeAfterStart_s = 1.5;

}  // namespace graben
