// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Numbers that were chosen for the excavator's estimates, each with why. Those of its loads and of
/// its oil are in `load` and `oil`.

namespace graben {

/// Share of a cycle's payload at rest that goes into the weighed one. [-; measured: half a second
/// of low-pass; `sweep.py`: soil's max_error_true_m 65.8; x0.7 61.9, x1.3 69.3]
inline constexpr double kPayloadWeight = 0.02;

}  // namespace graben
