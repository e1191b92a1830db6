// SPDX-License-Identifier: Apache-2.0
// A drive whose valve answers otherwise to each side: what is due of what was asked, and when.

#include <algorithm>
#include <cmath>
#include <vector>

#include "firmware/drives/drive_servo.hpp"
#include "tests/unit/firmware/two_sides.hpp"

constexpr double kPeriod_s = 0.01;

/// One side of a drive that answers as told.
class Side {
 public:
  explicit Side(const SpoolAnswer& answer)
      : waiting_(static_cast<std::size_t>(std::lround(answer.dead_time_s / kPeriod_s)), 0.0),
        share_(1.0 - std::exp(-kPeriod_s / (0.5 * answer.lag_s))) {}

  double after(double asked_mps) {
    waiting_.push_back(asked_mps);
    first_ += share_ * (waiting_.front() - first_);
    second_ += share_ * (first_ - second_);
    waiting_.erase(waiting_.begin());
    return second_;
  }

 private:
  std::vector<double> waiting_;
  double share_;
  double first_ = 0.0;
  double second_ = 0.0;
};

struct Bench {
  DriveRow row;
  ServoState servo;
  double stroke_m = 0.5;

  explicit Bench(const SpoolAnswers& answer) : extends_(answer.extend), retracts_(answer.retract) {
    row.answer = answer;
    row.most_travel_m = 1.0;
    row.feedback.error_most_m = 1.0;
    row.feedback.frequency_hz = 2.0;
    row.feedback.damping = 0.7;
    servo_at_rest(stroke_m, servo);
  }

  void step(double asked_mps) {
    stroke_m += kPeriod_s * (extends_.after(std::max(0.0, asked_mps)) +
                             retracts_.after(std::min(0.0, asked_mps)));
    next_servo(row, asked_mps, stroke_m, kPeriod_s, servo);
  }

 private:
  Side extends_;
  Side retracts_;
};

SpoolAnswers turned(const SpoolAnswers& answer) { return {answer.retract, answer.extend}; }

/// To and fro, fast and slow: it is behind by nothing, and stops where it was expected to.
TEST(a_drive_as_expected_is_not_behind) {
  for (const SpoolAnswers& answer : {test::two_sides(), turned(test::two_sides())}) {
    Bench bench(answer);
    for (int n = 0; n < 400; ++n) {
      bench.step(0.1 * std::sin(0.002 * n * n) + 0.02);
      assert_near(bench.servo.integral_m, 0.0, 1e-12);
    }
    const double predicted_m = stroke_then_m(bench.row, bench.servo);
    assert_true(std::abs(predicted_m - bench.stroke_m) > 1e-3);
    repeat(300, [&] { bench.step(0.0); });
    assert_near(bench.stroke_m, predicted_m, 1e-9);
    assert_near(bench.servo.under_way_m, 0.0, 1e-9);
  }
}

/// By the other side's times it would be behind, or ahead.
TEST(times_changed_over_are_found) {
  Bench bench(test::two_sides());
  bench.row.answer = turned(test::two_sides());
  repeat(100, [&] { bench.step(0.1); });
  // 0.15 s and 60 ms of lag more than expected.
  assert_near(bench.servo.integral_m, 0.1 * (0.15 + 0.06), 2e-4);
}

/// Sides that differ in one time alone are two sides.
TEST(one_time_that_differs_counts) {
  for (double SpoolAnswer::*time : {&SpoolAnswer::dead_time_s, &SpoolAnswer::lag_s}) {
    SpoolAnswers answer = test::two_sides();
    answer.extend = answer.retract;
    assert_true(answer.same_times());
    answer.extend.*time *= 3.0;
    assert_false(answer.same_times());
    Bench bench(answer);
    for (int n = 0; n < 200; ++n) {
      bench.step(0.1 * std::sin(0.1 * n));
      assert_near(bench.servo.integral_m, 0.0, 1e-12);
    }
  }
}
