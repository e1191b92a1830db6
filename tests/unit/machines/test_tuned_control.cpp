// SPDX-License-Identifier: Apache-2.0
// What a machine that answers late is controlled with.

#include "app/machines/tuned_control.hpp"

#include <cmath>
#include <complex>

#include "app/machines/excavator_file.hpp"
#include "tests/unit/cmocka_cpp.hpp"

using machines::tuned_control;
using machines::TunedControl;

constexpr double kTwoPi = 6.283185307179586;

/// Open loop of the servo at this frequency: gain, low-pass and integral, then dead time and two
/// equal lags.
std::complex<double> open_loop(const TunedControl& control, double dead_time_s, double lag_s,
                               double radps) {
  const std::complex<double> s(0.0, radps);
  const double omega = kTwoPi * control.servo_frequency_hz;
  const std::complex<double> filter =
      omega * omega / (s * s + 2.0 * control.servo_damping * omega * s + omega * omega);
  const std::complex<double> lag = 1.0 + 0.5 * lag_s * s;
  return control.servo_gain_ps * filter / s * std::exp(-dead_time_s * s) / (lag * lag);
}

/// The shipped machine is as it was tuned by hand.
TEST(the_shipped_machine_keeps_its_values) {
  const ExcavatorProfile profile =
      machines::load_excavator(machines::find_profile("excavator_22t")).profile;
  assert_near(machines::latest_answer_s(profile), 0.053, 1e-12);
  const TunedControl tuned =
      tuned_control(machines::latest_answer_s(profile), 2.76, profile.dig_speed_mps);
  assert_near(tuned.convergence_length_m, profile.control.convergence_length_m, 1e-12);
  assert_near(tuned.servo_gain_ps, profile.control.servo_gain_ps, 1e-12);
  assert_near(tuned.servo_frequency_hz, profile.control.servo_frequency_hz, 0.01);
  assert_near(tuned.servo_damping, profile.control.servo_damping, 1e-12);
  assert_near(tuned.pressure_filter_s, profile.control.pressure_filter_s, 1e-12);
}

/// Of all sides the latest one counts, by dead time and lag together.
TEST(the_latest_side_counts) {
  ExcavatorProfile profile =
      machines::load_excavator(machines::find_profile("excavator_22t")).profile;
  SaidAnswers& arm = profile.valve.answer[kArm];
  arm.extend.dead_time_s = 0.2;
  arm.retract.lag_s = 0.3;
  assert_near(machines::latest_answer_s(profile), 0.3, 1e-12);
  arm.extend.lag_s = 0.15;
  assert_near(machines::latest_answer_s(profile), 0.35, 1e-12);
}

/// However dead time and lag share it: a disk around -1 of a half stays free, so that a mode of the
/// oil or a dead time that is off by a fifth does not make the loop ring.
TEST(no_lateness_rings) {
  for (const double mode_hz : {1.5, 2.5, 4.0}) {
    for (double late_s = 0.02; late_s < 0.65; late_s += 0.01) {
      const TunedControl control = tuned_control(late_s, mode_hz, 0.6);
      for (const double share : {0.0, 0.5, 1.0}) {
        for (double radps = 0.1; radps < 100.0; radps *= 1.02) {
          const double dead_time_s = 1.2 * share * late_s;
          const double lag_s = (1.0 - share) * late_s;
          assert_true(std::abs(1.0 + open_loop(control, dead_time_s, lag_s, radps)) > 0.5);
        }
      }
    }
  }
}

/// The later, the calmer; at once at no place.
TEST(what_is_later_is_calmer) {
  TunedControl last = tuned_control(0.001, 2.5, 0.3);
  for (double late_s = 0.002; late_s < 0.7; late_s += 0.001) {
    const TunedControl next = tuned_control(late_s, 2.5, 0.3);
    assert_true(next.servo_gain_ps <= last.servo_gain_ps &&
                next.servo_gain_ps > last.servo_gain_ps - 0.02);
    assert_true(next.servo_damping >= last.servo_damping &&
                next.servo_damping < last.servo_damping + 0.01);
    assert_true(next.pressure_filter_s >= last.pressure_filter_s);
    assert_true(next.convergence_length_m >= last.convergence_length_m);
    assert_near(next.servo_frequency_hz, last.servo_frequency_hz, 0.0);
    last = next;
  }
  assert_near(last.convergence_length_m, 0.3, 1e-12);
  assert_near(last.servo_damping, 0.8, 1e-12);
  assert_near(last.pressure_filter_s, 0.4, 1e-12);
  assert_near(last.servo_gain_ps, 0.5 / (0.699 + 1.6 / (kTwoPi * 0.87 * 2.5)), 1e-3);
}
