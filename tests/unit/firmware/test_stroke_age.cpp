// SPDX-License-Identifier: Apache-2.0
// Strokes of one cycle are of one time, whenever their frames came.

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/excavator_steps.hpp"
#include "tests/unit/firmware/inputs.hpp"
#include "tests/unit/firmware/plain_machine.hpp"

using test::complete_inputs;

constexpr TimeUs kPeriod_us = 10 * kMillisecondUs;
constexpr double kFrom_m = 0.5;

/// A boom in motion, whose frames come `age_us` before their cycle.
struct Boom {
  explicit Boom(double speed) : speed_mps(speed) {}

  [[nodiscard]] double stroke_m(TimeUs at_us) const {
    return kFrom_m + speed_mps * static_cast<double>(at_us - kSecondUs) * 1e-6;
  }
  /// What is made of it in the next cycle.
  double step(TimeUs age_us, bool moving = true) {
    now_us += kPeriod_us;
    if (age_us >= 0) {
      newest = test::fresh(stroke_m(now_us - age_us), now_us - age_us);
    }
    ExcavatorInputs inputs = complete_inputs(now_us);
    inputs.axis[kBoom].stroke_m = newest;
    const test::Validated valid = test::validate(inputs, profile, state, moving, now_us);
    state = valid.state;
    return valid.drive[kBoom].stroke_m;
  }
  double run(int cycles, TimeUs age_us) {
    double last_m = 0.0;
    repeat(cycles, [&] { last_m = step(age_us); });
    return last_m;
  }

  ExcavatorProfile profile = test::plain_machine();
  double speed_mps;
  TimeUs now_us = kSecondUs;
  test::StrokesAccepted state;
  Signal<double> newest;
};

constexpr TimeUs kLost = -1;
constexpr TimeUs kAges_us[] = {0, 100, 5000, 9900};

TEST(a_frame_from_before_is_carried_on_to_now) {
  for (const double speed_mps : {0.3, -0.3}) {
    for (const TimeUs age_us : kAges_us) {
      Boom boom(speed_mps);
      const double last_m = boom.run(40, age_us);
      assert_near(last_m, boom.stroke_m(boom.now_us), 1e-5);
    }
  }
}

TEST(a_frame_of_this_instant_is_taken_as_it_is) {
  Boom boom(0.3);
  const double last_m = boom.run(40, 0);
  assert_near(last_m, boom.newest.value, 0.0);
}

/// By the phase of two clocks a frame now makes its cycle and now misses it.
TEST(frames_that_just_make_it_and_just_do_not) {
  Boom boom(0.3);
  boom.run(40, 5000);
  for (int n = 0; n < 20; ++n) {
    const double shown_m = boom.step(n % 2 == 0 ? 100 : 9900);
    assert_near(shown_m, boom.stroke_m(boom.now_us), 2e-5);
  }
}

/// A stroke whose frames stay away is carried on no farther than to the next of them.
TEST(a_lost_frame_is_not_made_up) {
  Boom boom(0.3);
  boom.run(40, 0);
  const double newest_m = boom.newest.value;
  assert_near(boom.step(kLost), newest_m + 0.3 * 0.010, 1e-5);
  assert_near(boom.step(kLost), newest_m + 0.3 * 0.012, 1e-5);
  assert_near(boom.step(kLost), newest_m + 0.3 * 0.012, 1e-5);
}

/// Into what is sensed, as the frame itself.
TEST(never_beyond_the_sensor) {
  for (const int side : {1, -1}) {
    Boom boom(0.3 * side);
    const DriveWatch watch = excavator_bank(boom.profile).row[kBoom].watch;
    const double end_m = side > 0 ? watch.sensed_most_m : watch.sensed_least_m;
    boom.now_us += static_cast<TimeUs>((end_m - kFrom_m) / (0.3 * side) * 1e6) - 40 * kPeriod_us;
    boom.run(39, 9900);
    assert_near(boom.step(9900), end_m, 2e-4);
    assert_near(boom.step(9900), end_m, 0.0);
  }
}

/// At rest it may be moved by hand: nothing is carried on, and motion begins anew.
TEST(at_rest_nothing_is_carried_on) {
  Boom boom(0.3);
  boom.run(40, 9900);
  const double at_rest_m = boom.step(9900, false);
  assert_near(at_rest_m, boom.newest.value, 0.0);
  const double begins_m = boom.step(9900);
  assert_near(begins_m, boom.newest.value, 2e-3);
}
