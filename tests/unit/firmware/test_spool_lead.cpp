// SPDX-License-Identifier: Apache-2.0
#include "firmware/drives/lead/spool_lead.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/core/time.hpp"
#include "tests/unit/cmocka_cpp.hpp"

/// The same spool, stepped finely, is where it was to be after two cycles.
TEST(a_led_spool_arrives_in_two_cycles) {
  constexpr double kTime_s = 0.02;
  constexpr double kFine_s = 1e-5;
  SpoolModel model;
  double travel = 0.0;
  double speed_ps = 0.0;
  for (int cycle = 0; cycle < 40; ++cycle) {
    const double duty = led_duty(kTime_s, 0.25, model);
    model = spool_after(kTime_s, duty, model);
    assert_true(duty >= -1.0 && duty <= 1.0);
    for (int n = 0; n < 1000; ++n) {
      speed_ps += kFine_s * ((duty - travel) / kTime_s - 2.0 * speed_ps) / kTime_s;
      travel += kFine_s * speed_ps;
    }
    assert_near(travel, model.travel_ratio, 1e-3);
    assert_true(cycle < 3 || std::abs(travel - 0.25) < 0.02);
  }
  SpoolModel none;
  assert_near(led_duty(0.0, -0.3, none), -0.3, 0.0);
}

/// What a spool is sent that is led while it follows with a lag of its own, and where it then is.
struct Following {
  double lag_s;
  LedSpool led;
  SpoolModel real;
  double added = 0.0;  ///< Most that the lead added.

  /// To and fro for a while.
  void go(double time_s) {
    for (int n = 0; n < static_cast<int>(std::lround(time_s / kCyclePeriod_s)); ++n) {
      const double wanted = 0.4 + 0.2 * std::sin(0.1 * n) + ((n / 30) % 2 == 0 ? 0.05 : 0.0);
      judge_model(0.02, real.travel_ratio, led);
      const double duty = trusted_lead(0.02, wanted, led);
      added = std::max(added, std::abs(duty - wanted));
      next_led(0.02, duty, led);
      real = spool_after(lag_s, duty, real);
    }
  }
};

/// A spool as told is led; one that is three times as slow is not, until it is as
/// told again.
TEST(no_spool_is_led_by_a_model_that_it_does_not_follow) {
  Following sound{0.02, {}, {}};
  sound.go(20.0);
  // Not even from rest by as much as a dead band, or a duty changes its sign for nothing.
  assert_true(sound.added > 0.05 && sound.added < 0.1 + 1e-9);
  sound.added = 0.0;  // The way from rest is another.
  sound.go(5.0);
  assert_true(sound.added > 0.05);
  Following slow{0.06, {}, {}};
  slow.go(20.0);
  slow.added = 0.0;
  slow.go(5.0);
  assert_true(slow.added < 0.2 * sound.added);
  slow.lag_s = 0.02;
  slow.go(20.0);
  slow.go(5.0);
  assert_true(slow.added > 0.5 * sound.added);
}

/// From rest no duty is more than four times what is wanted, however slow the spool is; where it is
/// to be, it is after its time constant.
TEST(a_slow_spool_is_not_driven_to_its_ends) {
  for (const double time_s : {0.02, 0.03, 0.045, 0.1}) {
    SpoolModel model;
    const int within = static_cast<int>(std::lround(2.0 * time_s / 0.01));
    for (int cycle = 0; cycle < 60; ++cycle) {
      const double duty = led_duty(time_s, 0.2, model);
      model = spool_after(time_s, duty, model);
      assert_true(std::abs(duty) < 0.8);
      assert_true(cycle < within || std::abs(model.travel_ratio - 0.2) < 0.02);
    }
  }
}
