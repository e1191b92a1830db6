// SPDX-License-Identifier: Apache-2.0
#pragma once
/// All servos of the shipped 22 t machine a cycle on, in values, with a control in round numbers.

#include "tests/unit/firmware/excavator_steps.hpp"
#include "tests/unit/firmware/fixture.hpp"

namespace graben::test {

inline ControlProfile control(double dead_time_s = 0.0) {
  ControlProfile profile;
  profile.response_s = 0.05;
  profile.dead_time_s = dead_time_s;
  profile.servo_gain_ps = 2.0;
  profile.servo_most_m = 0.02;
  profile.servo_least_lambda = 0.2;
  profile.servo_frequency_hz = 2.4;
  profile.servo_damping = 0.4;
  return profile;
}

/// The shipped machine with this control.
inline ExcavatorProfile machine() {
  ExcavatorProfile profile = excavator().profile;
  const double stroke_end_gain_ps = profile.control.stroke_end_gain_ps;
  profile.control = control();
  profile.control.stroke_end_gain_ps = stroke_end_gain_ps;
  return profile;
}

/// All drives a cycle on.
inline ExcavatorServo next_servo(const ControlProfile& control, ExcavatorServo servo,
                                 const DriveVector& asked_mps, const DriveVector& strokes_m,
                                 double period_s) {
  ExcavatorProfile profile = excavator().profile;
  profile.control = control;
  const ExcavatorBank bank = excavator_bank(profile);
  for (int i = 0; i < bank.count; ++i) {
    graben::next_servo(bank.rows()[i], asked_mps[i], strokes_m[i], period_s,
                       servo.drive[static_cast<unsigned>(i)]);
  }
  return servo;
}
inline ExcavatorServo servo_released(const ControlProfile& control, ExcavatorServo servo,
                                     const DriveVector& strokes_m, double period_s) {
  ExcavatorProfile profile = excavator().profile;
  profile.control = control;
  const ExcavatorBank bank = excavator_bank(profile);
  for (int i = 0; i < bank.count; ++i) {
    release_servo(bank.rows()[i], strokes_m[i], period_s, servo.drive[static_cast<unsigned>(i)]);
  }
  return servo;
}
inline ExcavatorServo next_servo_on_plan(const ExcavatorProfile& profile, ExcavatorServo servo,
                                         const DriveVector& asked_mps, const DriveVector& strokes_m,
                                         const DriveVector& planned_m, bool new_plan,
                                         double period_s) {
  const ExcavatorBank bank = excavator_bank(profile);
  for (int i = 0; i < bank.count; ++i) {
    graben::next_servo_on_plan(bank.rows()[i], asked_mps[i], strokes_m[i], planned_m[i], new_plan,
                               period_s, servo.drive[static_cast<unsigned>(i)]);
  }
  return servo;
}

}  // namespace graben::test
