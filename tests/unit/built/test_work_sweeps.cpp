// SPDX-License-Identifier: Apache-2.0
#include "app/ecu/ground/work_sweeps.hpp"
#include "tests/unit/cmocka_cpp.hpp"

/// A second of 0.5 m/s inwards from 6 m, or outwards to it; the level force by the time of it.
template <class Force>
void sweep(double way, double begin_s, const Force& level_n, double deviation_n,
           std::vector<ground::EdgeStep>& steps) {
  for (int n = 1; n <= 100; ++n) {
    ground::EdgeStep step;
    step.time_s = begin_s + 0.01 * n;
    step.from.outwards_m = 5.0 - way * 0.25 + way * 0.005 * (n - 1);
    step.to.outwards_m = step.from.outwards_m + way * 0.005;
    step.to.left_m = {step.to.outwards_m, 0.5, 0.0};
    step.to.right_m = {step.to.outwards_m, -0.5, 0.0};
    step.to.level_n = level_n(0.01 * n);
    step.to.deviation_n = deviation_n;
    steps.push_back(step);
  }
}

/// Times at which it was at work.
std::vector<double> worked_s(const std::vector<ground::EdgeStep>& steps) {
  std::vector<double> times;
  std::size_t given = 0;
  const ground::WorkSweeps::Take take = [&](const ground::EdgeStep& step) {
    assert_near(step.time_s, steps[given++].time_s, 0.0);
    if (step.to.at_work) {
      times.push_back(step.time_s);
    }
  };
  ground::WorkSweeps sweeps(take);
  for (const ground::EdgeStep& step : steps) {
    sweeps.add(step);
  }
  sweeps.end();
  assert_int_equal(given, steps.size());
  return times;
}

/// Ground from 0.3 to 0.8 s of the sweep: weak, strong for so long, weak.
auto ground(double strong_n, double strong_s, double weak_n) {
  return [=](double time_s) {
    if (time_s < 0.295 || time_s > 0.805) {
      return 0.0;
    }
    return time_s > 0.4 && time_s < 0.4 + strong_s ? strong_n : weak_n;
  };
}

TEST(a_sweep_is_work_from_the_first_to_the_last_moment_that_ground_is_felt) {
  std::vector<ground::EdgeStep> steps;
  sweep(-1.0, 0.0, ground(9e3, 0.25, 2e3), 1e3, steps);
  const std::vector<double> times = worked_s(steps);
  assert_int_equal(times.size(), 51);
  assert_near(times.front(), 0.30, 1e-9);
  assert_near(times.back(), 0.80, 1e-9);
}

/// It holds the edge back, whichever way that goes; pushed on, nothing is cut.
TEST(the_force_is_against_the_way) {
  std::vector<ground::EdgeStep> outwards;
  sweep(1.0, 0.0, ground(-11e3, 0.25, -2e3), 1e3, outwards);
  assert_int_equal(worked_s(outwards).size(), 51);
  std::vector<ground::EdgeStep> poured;
  sweep(1.0, 0.0, ground(-9e3, 0.25, -2e3), 1e3, poured);
  assert_true(worked_s(poured).empty());
  std::vector<ground::EdgeStep> pushed;
  sweep(1.0, 0.0, ground(9e3, 0.25, 2e3), 1e3, pushed);
  assert_true(worked_s(pushed).empty());
}

TEST(what_is_weak_short_or_unsure_is_no_work) {
  const auto none = [](double strong_n, double strong_s, double deviation_n) {
    std::vector<ground::EdgeStep> steps;
    sweep(-1.0, 0.0, ground(strong_n, strong_s, 2e3), deviation_n, steps);
    return worked_s(steps).empty();
  };
  assert_false(none(5.5e3, 0.25, 1e3));
  assert_true(none(4.5e3, 0.25, 1e3));  // 5 kN a metre of the edge.
  assert_true(none(9e3, 0.1, 1e3));
  assert_true(none(9e3, 0.25, 5e3));
  assert_true(none(9e3, 0.25, 0.0));  // Nothing is told.
}

/// Felt again on the way back, but never strongly: the sweeps are apart.
TEST(a_sweep_ends_where_the_edge_turns) {
  std::vector<ground::EdgeStep> steps;
  sweep(-1.0, 0.0, ground(9e3, 0.25, 2e3), 1e3, steps);
  sweep(1.0, 1.0, ground(-2e3, 0.25, -2e3), 1e3, steps);
  assert_near(worked_s(steps).back(), 0.80, 1e-9);
}

/// A minute and more in one go: fewer steps, the way whole, and known where it was at work.
TEST(a_long_sweep_is_kept_in_fewer_steps) {
  constexpr int kLong = 3 * static_cast<int>(ground::kMostSteps) + 5;
  int given = 0;
  int worked = 0;
  double at_m = 6.0;
  double until_s = 0.0;
  const ground::WorkSweeps::Take take = [&](const ground::EdgeStep& step) {
    assert_near(step.from.outwards_m, at_m, 0.0);
    at_m = step.to.outwards_m;
    until_s = step.time_s;
    ++given;
    worked += step.to.at_work ? 1 : 0;
  };
  ground::WorkSweeps sweeps(take);
  ground::EdgeStep step;
  step.to.outwards_m = 6.0;
  for (int n = 1; n <= kLong; ++n) {
    step.from = step.to;
    step.time_s = 0.01 * n;
    step.to.outwards_m -= 0.0006;
    step.to.left_m = {step.to.outwards_m, 0.5, 0.0};
    step.to.right_m = {step.to.outwards_m, -0.5, 0.0};
    step.to.level_n = 9e3;
    step.to.deviation_n = 1e3;
    sweeps.add(step);
  }
  sweeps.end();
  assert_near(at_m, step.to.outwards_m, 0.0);
  assert_near(until_s, step.time_s, 0.0);
  assert_in_range(given, static_cast<int>(ground::kMostSteps) / 2,
                  static_cast<int>(ground::kMostSteps));
  assert_int_equal(worked, given);
}
