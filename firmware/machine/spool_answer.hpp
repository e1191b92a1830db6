// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How a spool answers its duty, one side and the other.

#include "firmware/numeric/monotone_table.hpp"

namespace graben {

/// Of an opening to its duty.
using DutyTable = MonotoneTableOf<16>;

/// One side of a drive's spool.
struct SpoolAnswer {
  /// Opening (0 .. 1; to the power of opening_exponent it is the share of the full area) to duty
  /// (0 .. 1). A duty is a share of the spool's full travel as well. The first one is where the
  /// spool begins to open, so that the dead band is crossed in one step; neutral is duty 0 always.
  DutyTable spool_to_duty;
  double dead_time_s = 0.0;            ///< From a duty to the spool's first movement.
  double lag_s = 0.0;                  ///< Of the drive's speed behind its spool's command.
  double spool_time_constant_s = 0.0;  ///< 1 / natural frequency of the spool; 0: not known.

  /// Duty at which the dead band ends.
  [[nodiscard]] double edge() const { return spool_to_duty.y_first(); }
};

struct SpoolAnswers {
  SpoolAnswer extend;
  SpoolAnswer retract;

  [[nodiscard]] const SpoolAnswer& side(bool extends) const { return extends ? extend : retract; }
  [[nodiscard]] SpoolAnswer& side(bool extends) { return extends ? extend : retract; }
  /// Of a way with a sign; extension is positive.
  [[nodiscard]] const SpoolAnswer& towards(double way) const { return side(way > 0.0); }
  /// Both sides are as late and as slow as each other.
  [[nodiscard]] bool same_times() const {
    return extend.dead_time_s == retract.dead_time_s && extend.lag_s == retract.lag_s;
  }
};

/// Stands for a time that a side of a spool does not say by itself. [s; derived: below 0 there is
/// no such time]
inline constexpr double kUnsaid_s = -1.0;

/// A SpoolAnswer as far as it is known of one side by itself.
struct SaidAnswer {
  DutyTable spool_to_duty;  ///< Empty: not said.
  double dead_time_s = kUnsaid_s;
  double lag_s = kUnsaid_s;
  double spool_time_constant_s = kUnsaid_s;
};

struct SaidAnswers {
  SaidAnswer extend;
  SaidAnswer retract;

  [[nodiscard]] const SaidAnswer& side(bool extends) const { return extends ? extend : retract; }
  [[nodiscard]] SaidAnswer& side(bool extends) { return extends ? extend : retract; }
};

}  // namespace graben
