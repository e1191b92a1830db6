// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A drive with round numbers for the tests of its flow.

#include <cmath>

#include "firmware/drives/flow_watch.hpp"
#include "tests/unit/cmocka_cpp.hpp"

namespace graben::test::of_flow {

inline constexpr double kPeriod_s = 0.01;
inline constexpr double kEngine_radps = 100.0;
inline constexpr double kEdge = 0.2;
inline constexpr double kZero_pa = 1.2e6;
inline constexpr double kLost_pa = kZero_pa + 0.5e6;  ///< And to the return line.

/// Flow is area times sqrt(pressure) times opening; the cap side is twice as large as the rod side.
inline DriveRow plain() {
  DriveRow row;
  row.most_travel_m = 1.0;
  row.extend_area_m2 = 0.02;
  row.retract_area_m2 = 0.01;
  row.spool.extend_in_m2 = 4e-6;
  row.spool.extend_out_m2 = 2e-6;
  row.spool.retract_in_m2 = 3e-6;
  row.spool.retract_out_m2 = 5e-6;
  row.spool.c_drain = 1e-6;
  row.spool.c_check = 2e-6;
  row.metering.discharge = 1.0;
  row.metering.density_kgpm3 = 2.0;
  const double opens[] = {0.0, 1.0};
  const double duty[] = {kEdge, 1.0};
  assert_int_equal(row.answer.extend.spool_to_duty.fill(opens, duty, 2), MonotoneTable::Fill::kOk);
  row.answer.retract = row.answer.extend;
  row.watch.pressure_rail_pa = 40e6;
  row.watch.off_m = 0.008;
  row.watch.unseen_m = 0.003;
  return row;
}

inline ValidDrive at(double spool_ratio, double cap_pa, double rod_pa) {
  ValidDrive seen;
  seen.stroke_m = 0.5;
  seen.spool_ratio = spool_ratio;
  seen.cap_pressure_pa = cap_pa;
  seen.rod_pressure_pa = rod_pa;
  seen.load_known = true;
  seen.stroke_is_new = true;
  return seen;
}

/// A valve that is the profile's for certain.
inline LearntValve as_profiled() {
  LearntValve valve;
  for (LearntSide* side : {&valve.extend, &valve.retract}) {
    side->edge_variance = 0.0;
    side->bend_variance = 0.0;
  }
  return valve;
}

inline double opening(double spool_ratio, double band) {
  return (spool_ratio + band - kEdge) / 0.8;
}

inline double series(double first, double second) {
  return first * second / std::sqrt(first * first + second * second);
}

inline void assert_range(const SpeedRange& range, double least_mps, double most_mps) {
  assert_near(range.least_mps, least_mps, 1e-9);
  assert_near(range.most_mps, most_mps, 1e-9);
}

inline DriveRow metered_inlet() {
  DriveRow row = plain();
  row.supply = {2e-3, 1e-5};
  row.watch.senses_load = false;
  return row;
}

}  // namespace graben::test::of_flow
