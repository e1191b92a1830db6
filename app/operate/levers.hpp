// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The operator's two levers, from sticks or keys to the axes on the bus. They lie as on an
/// excavator with ISO controls (ISO 10968): the left lever swings and moves the arm, the right one
/// moves boom and bucket. A push moves metal the same way in every task.

#include "firmware/signals/machine_signals.hpp"

namespace graben::operate {

/// Where a lever is, each way -1 .. 1 of its travel; 0 at rest.
struct Lever {
  double right_ratio = 0.0;
  double away_ratio = 0.0;  ///< From the operator.
};

struct Levers {
  Lever left;
  Lever right;

  [[nodiscard]] bool are_at_rest() const;
};

/// As OperatorAxes has them, -1 .. 1.
struct Axes {
  double boom_or_up_ratio = 0.0;
  double arm_or_forward_ratio = 0.0;
  double bucket_or_attitude_ratio = 0.0;
  double swing_ratio = 0.0;
};

/// Left lever: right swings right, away moves the arm or the teeth out. Right lever: away lowers
/// boom or teeth, right opens the bucket. The arm's and bucket's cylinders extend to move in and
/// to curl: there the signs of Jog, which counts extensions, and of the other tasks differ.
[[nodiscard]] Axes axes_of(const Levers& levers, Task task);

/// Share of a stick's travel in which it is at rest: sticks do not come back to the same place.
inline constexpr double kDeadZone = 0.12;
/// Share of the third power in the rest: fine near the middle, full at the end.
inline constexpr double kExpo = 0.6;

/// What a stick's driver says of one of its axes.
struct StickRange {
  int least = 0;
  int most = 0;
  int flat = 0;  ///< Within so much of the middle its value means nothing.
};

/// -1 .. 1 of a raw position: 0 in the dead zone, or in the driver's own if that is larger; beyond
/// it, with x the share of the way from there to the end, (1 - kExpo) x + kExpo x^3. 0 of a range
/// that is none.
[[nodiscard]] double stick_ratio(int raw, const StickRange& range);

}  // namespace graben::operate
