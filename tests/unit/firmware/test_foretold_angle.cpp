// SPDX-License-Identifier: Apache-2.0
// An angle that comes late, foretold by its rate.

#include "firmware/estimation/foretold_angle.hpp"

#include <cmath>

#include "tests/unit/cmocka_cpp.hpp"

constexpr double kLatency_s = 0.02;
constexpr TimeUs kPeriod = 10 * kMillisecondUs;

Signal<double> shown(double angle_rad, TimeUs at_us) {
  return {angle_rad, Validity::kValid, at_us};
}

TEST(what_turns_evenly_is_where_it_is, ForetoldAngle state) {
  for (TimeUs at_us = 0; at_us < 10 * kPeriod; at_us += kPeriod) {
    const double time_s = static_cast<double>(at_us) / kSecondUs;
    const Signal<double> ahead =
        foretold(shown(0.5 * (time_s - kLatency_s), at_us), kLatency_s, state);
    if (at_us >= 2 * kPeriod) {
      assert_near(ahead.value, 0.5 * time_s, 1e-12);
    }
    assert_int_equal(ahead.stamp_us, at_us);
  }
}

/// A link on its oil: of 20 ms of lag at 3 Hz less than a quarter is left.
TEST(what_swings_lags_little) {
  constexpr double kOmega = 2.0 * 3.14159265358979 * 3.0;
  ForetoldAngle state;
  double most_late = 0.0;
  double most_ahead = 0.0;
  for (TimeUs at_us = 0; at_us < 100 * kPeriod; at_us += kPeriod) {
    const double time_s = static_cast<double>(at_us) / kSecondUs;
    const double late = std::sin(kOmega * (time_s - kLatency_s));
    const Signal<double> ahead = foretold(shown(late, at_us), kLatency_s, state);
    if (at_us >= 2 * kPeriod) {
      most_late = std::max(most_late, std::abs(late - std::sin(kOmega * time_s)));
      most_ahead = std::max(most_ahead, std::abs(ahead.value - std::sin(kOmega * time_s)));
    }
  }
  assert_in_range(static_cast<int>(1e3 * most_late), 360, 380);
  assert_in_range(static_cast<int>(1e3 * most_ahead), 10, 150);
}

TEST(a_reading_that_does_not_come_changes_nothing, ForetoldAngle state) {
  static_cast<void>(foretold(shown(0.00, 0), kLatency_s, state));
  static_cast<void>(foretold(shown(0.01, kPeriod), kLatency_s, state));
  const double once = foretold(shown(0.02, 2 * kPeriod), kLatency_s, state).value;
  assert_near(once, 0.04, 1e-12);
  assert_near(foretold(shown(0.02, 2 * kPeriod), kLatency_s, state).value, once, 0.0);
}

TEST(what_is_not_known_is_as_it_is_shown, ForetoldAngle state) {
  static_cast<void>(foretold(shown(0.0, 0), kLatency_s, state));
  static_cast<void>(foretold(shown(0.1, kPeriod), kLatency_s, state));
  // After a gap.
  assert_near(foretold(shown(0.5, 10 * kPeriod), kLatency_s, state).value, 0.5, 0.0);
  const Signal<double> error{0.0, Validity::kError, 11 * kPeriod};
  assert_true(foretold(error, kLatency_s, state).validity == Validity::kError);
  // Nothing from before it counts.
  assert_near(foretold(shown(0.6, 12 * kPeriod), kLatency_s, state).value, 0.6, 0.0);
  assert_near(foretold(shown(0.7, 13 * kPeriod), kLatency_s, state).value, 0.7, 0.0);
}

TEST(what_comes_in_time_stays, ForetoldAngle state) {
  for (TimeUs at_us = 0; at_us < 5 * kPeriod; at_us += kPeriod) {
    const double angle_rad = 1e-7 * static_cast<double>(at_us);
    assert_near(foretold(shown(angle_rad, at_us), 0.0, state).value, angle_rad, 0.0);
  }
}
