// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A drive whose valve is not what its profile says, for tests of what is learnt of it.

#include <cmath>

#include "firmware/drives/learnt/learnt_valve.hpp"
#include "tests/unit/cmocka_cpp.hpp"

namespace graben::test::learnt {

inline constexpr double kPeriod_s = 0.01;
inline constexpr double kEdge = 0.2;
inline constexpr double kFull_mps = 0.5;

/// A drive whose valve is what its sides say, moved as its profile thinks right.
struct Bench {
  struct Side {
    double edge = kEdge;
    double exponent = 1.6;
  };

  DriveRow row;
  Side extend;
  Side retract;
  LearntValve valve;
  double stroke_m = 0.5;
  bool corrected = true;  ///< Its spool goes where the learnt valve has it.

  Bench() {
    const double opens[] = {0.0, 1.0};
    const double duty[] = {kEdge, 1.0};
    assert_int_equal(row.answer.extend.spool_to_duty.fill(opens, duty, 2),
                     MonotoneTable::Fill::kOk);
    row.answer.retract = row.answer.extend;
    row.metering.opening_exponent = 1.6;
    row.answer.extend.lag_s = 0.03;
    row.answer.retract.lag_s = 0.03;
    step(0.0, LearntFrom::kNothing);  // Before the machine moves.
  }

  void step(double asked_mps, LearntFrom from = LearntFrom::kPlainMotion) {
    const double way = std::copysign(1.0, asked_mps);
    const double opening = way * std::pow(std::abs(asked_mps) / kFull_mps, 1.0 / 1.6);
    const double duty = corrected ? learnt_duty(row, valve, opening)
                                  : way * (kEdge + (1.0 - kEdge) * std::abs(opening));
    const Side& real = asked_mps > 0.0 ? extend : retract;
    const double share = std::max(0.0, std::abs(duty) - real.edge) / (1.0 - real.edge);
    stroke_m += kPeriod_s * way * kFull_mps * std::pow(share, real.exponent);
    ValidDrive seen;
    seen.stroke_m = stroke_m;
    seen.spool_ratio = duty;
    next_learnt(row, seen, {asked_mps, opening}, from, kPeriod_s, valve);
  }
  /// Slow and fast by turns, a second each.
  void work(double seconds, double way, LearntFrom from = LearntFrom::kPlainMotion) {
    for (int n = 0; n < static_cast<int>(100.0 * seconds); ++n) {
      step(way * (n / 100 % 2 == 0 ? 0.05 : 0.15), from);
    }
  }
  /// Speed that it is then off at this one, of the asked speed.
  double off(double asked_mps) {
    repeat(50, [&] { step(asked_mps); });
    const double from_m = stroke_m;
    step(asked_mps);
    return (stroke_m - from_m) / kPeriod_s / asked_mps - 1.0;
  }
};

}  // namespace graben::test::learnt
