// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A cylinder under the guard of commissioning.

#include <initializer_list>

#include "firmware/drives/commission_guard.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/excavator_steps.hpp"
#include "tests/unit/firmware/plain_machine.hpp"

namespace graben::test::guarded {

inline constexpr double kPeriod_s = 0.01;
inline constexpr double kStroke_m = 1.0;  // Of the plain machine's bucket.
inline constexpr double kRelief_pa = 30e6;
inline constexpr StrokeWindow kWhole = {0.0, kStroke_m, 0.5};

/// A cylinder that goes as a test says; what may be sent is sent.
struct Cylinder {
  DriveRow row = excavator_bank(plain_machine()).row[2];
  CommissionState state;
  CommissionAsk ask;
  ValidDrive seen;
  CommissionResult result;
  double moved_m = 0.0;  ///< Since a test has set it to 0.

  explicit Cylinder(double stroke_m = 0.5, const StrokeWindow& window = {0.2, 0.8, 0.5}) {
    row.watch.relief_pa = kRelief_pa;
    ask.window = window;
    seen.stroke_m = stroke_m;
    seen.load_known = true;
    seen.cap_pressure_pa = 5e6;
    seen.rod_pressure_pa = 2e6;
    run(1.0, 0.0, 0.0);
    assert_int_equal(result.fault, Fault::kNone);
    moved_m = 0.0;
  }

  Fault step(double duty, double speed_mps) {
    seen.stroke_m += speed_mps * kPeriod_s;
    moved_m += speed_mps * kPeriod_s;
    ask.sent_ratio = result.duty_ratio;
    ask.wanted_ratio = duty;
    result = next_commission(row, ask, seen, kPeriod_s, state);
    return result.fault;
  }
  /// Ends with a fault.
  Fault run(double time_s, double duty, double speed_mps) {
    Fault fault = Fault::kNone;
    for (double at_s = 0.0; at_s < time_s && fault == Fault::kNone; at_s += kPeriod_s) {
      fault = step(duty, speed_mps);
    }
    return fault;
  }
};

}  // namespace graben::test::guarded
