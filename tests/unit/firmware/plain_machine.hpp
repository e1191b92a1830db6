// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A machine in round numbers, made without a file: enough of a profile for the safety code, so
/// that limits can be hit to the last bit and nothing of the application has to be built.

#include "firmware/excavator/excavator_profile.hpp"
#include "tests/unit/cmocka_cpp.hpp"

namespace graben::test {

inline constexpr double kPi = 3.14159265358979323846;

/// Boom and bucket go 1 m/s with their pump's whole flow twice over, the arm 2 m/s.
inline ExcavatorProfile plain_machine() {
  ExcavatorProfile profile;
  const double stroke_m[] = {1.25, 1.5, 1.0};
  const int pump[] = {0, 1, 0};
  for (unsigned i = 0; i < kAxisCount; ++i) {
    profile.geometry.cylinder[i].bore_m = 0.12;
    profile.geometry.cylinder[i].rod_m = 0.08;  // A_B = 0.002 pi
    profile.geometry.cylinder[i].stroke_m = stroke_m[i];
    profile.valve.spool[i].pump = pump[i];
  }
  for (unsigned j = 0; j < kPumpCount; ++j) {
    profile.pump[j].displacement_m3prev = 2.0 * kPi * 1e-5 * (1.0 + j);
    profile.pump[j].rated_speed_radps = 100.0 * kPi;
    profile.dig_swash_ratio[j] = 0.5 + 0.25 * j;
  }
  const double opening[] = {0.0, 1.0};
  const double duty[] = {0.25, 1.0};
  const MonotoneTable::Fill filled = profile.valve.spool_to_duty.fill(opening, duty, 2);
  assert_int_equal(filled, MonotoneTable::Fill::kOk);
  profile.valve.spool_travel_m = 0.0078125;
  profile.control.spool_rate_ps = 3.125;
  profile.control.spool_threshold = 0.03125;
  profile.control.sensor_timeout_s = 0.045;
  profile.control.dead_time_s = 0.0;
  profile.safety.degraded_speed_ratio = 0.25;
  profile.safety.idle_radps = 90.0;
  profile.safety.settle_s = 0.1;
  profile.safety.spool_tolerance = 0.125;
  profile.safety.uncommanded_m = 0.0625;
  profile.safety.stuck_m = 0.0625;
  profile.safety.swash_tolerance = 0.125;
  profile.safety.pressure_rail_pa = 40e6;
  return profile;
}

/// The same with a swing on the first pump, 1 m/s at its lever too; its range is 2 rad each way.
inline ExcavatorProfile plain_machine_with_swing() {
  ExcavatorProfile profile = plain_machine();
  profile.drive_count = kDriveCount;
  profile.swing.lever_m = 0.125;
  profile.swing.displacement_m3prad = 0.125 * 0.002 * kPi;
  profile.swing.right_end_rad = -2.0;
  profile.swing.left_end_rad = 2.0;
  profile.swing.speed_max_radps = 1.0;
  profile.swing.acceleration_max_radps2 = 0.5;
  profile.valve.spool[kSwing].pump = 0;
  profile.safety.swing_uncommanded_rad = 0.25;
  profile.safety.swing_stuck_rad = 0.5;
  return profile;
}

}  // namespace graben::test
