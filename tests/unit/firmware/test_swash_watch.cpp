// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/safety/excavator_validation.hpp"

#include <algorithm>
#include <cmath>

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/plain_machine.hpp"

constexpr std::array<double, kPumpCount> kWanted = {0.5, 0.75};
constexpr double kTolerance = 0.125;

struct Pumps {
  std::array<double, kPumpCount> swash = kWanted;
  std::array<double, kPumpCount> wanted = kWanted;
  SwashStates state = {{{0.0, kWanted[0]}, {0.0, kWanted[1]}}};
  std::array<double, kPumpCount> flow_with{};
  ExcavatorProfile profile = test::plain_machine();

  bool disagree(double period_s, bool commanded = true) {
    flow_with = swash;
    return watch_swash(profile, commanded, wanted, period_s, flow_with, state);
  }
  void assert_flow_with(double first, double second) const {
    assert_near(flow_with[0], first, 0.0);
    assert_near(flow_with[1], second, 0.0);
  }
};

/// Off by the tolerance for ever is well; by the next number it is not, either way, either pump.
TEST(the_tolerance_is_a_sharp_edge) {
  for (unsigned pump = 0; pump < kPumpCount; ++pump) {
    for (const double sign : {1.0, -1.0}) {
      Pumps pumps;
      pumps.swash[pump] = kWanted[pump] + sign * kTolerance;
      assert_false(pumps.disagree(10.0));
      pumps.swash[pump] = std::nextafter(pumps.swash[pump], sign * 9.0);
      assert_true(pumps.disagree(10.0));
    }
  }
}

/// The servo has 0.5 s; a moment of agreement gives it as much again.
TEST(the_servo_is_given_its_time, Pumps pumps) {
  pumps.swash[0] = 0.0;
  assert_false(pumps.disagree(0.25));
  assert_false(pumps.disagree(0.25));
  pumps.assert_flow_with(0.0, kWanted[1]);
  assert_true(pumps.disagree(1e-6));
  pumps.swash[0] = kWanted[0];
  assert_false(pumps.disagree(0.25));
  pumps.swash[0] = 0.0;
  assert_false(pumps.disagree(0.5));
  assert_true(pumps.disagree(1e-6));
}

/// The smaller of command and feedback, of that pump alone, and only once it disagrees.
TEST(the_smaller_one_counts, Pumps more) {
  more.swash = {0.25, 1.0};
  assert_false(more.disagree(0.5));
  more.assert_flow_with(0.25, 1.0);
  assert_true(more.disagree(0.5));
  more.assert_flow_with(0.25, kWanted[1]);
  Pumps near;
  near.swash = {0.5625, 0.25};
  assert_true(near.disagree(1.0));
  near.assert_flow_with(0.5625, 0.25);
}

/// A pump that sets its own swash goes where the drives need it.
TEST(a_regulated_pump_is_not_asked, Pumps own) {
  own.profile.pump[1].regulator.kind = PumpKind::kLoadSensing;
  own.swash[1] = 0.1;
  assert_false(own.disagree(10.0));
  own.assert_flow_with(kWanted[0], 1.0);
}

/// A pump that is not there answers nothing.
TEST(only_the_machine_s_pumps_are_asked, Pumps one) {
  one.profile.pump_count = 1;
  one.swash[1] = 0.0;
  assert_false(one.disagree(10.0));
  one.swash[0] = 0.0;
  assert_true(one.disagree(10.0));
}

/// Without a command nothing is asked, and nothing is remembered.
TEST(without_a_command_nothing_is_asked, Pumps pumps) {
  pumps.swash = {0.0, 0.0};
  assert_false(pumps.disagree(10.0, false));
  pumps.assert_flow_with(0.0, 0.0);
  assert_false(pumps.disagree(0.5));
  assert_false(pumps.disagree(10.0, false));
  assert_false(pumps.disagree(0.5));
}

/// Of a command that goes up and down by 0.4 within a second, a pump that lags 0.15 s behind is
/// well, though it is off by more than the tolerance; one that stays where it was is not.
TEST(a_command_may_move) {
  for (const bool follows : {true, false}) {
    Pumps pumps;
    bool disagreed = false;
    double farthest = 0.0;
    for (int cycle = 0; cycle < 400; ++cycle) {
      pumps.wanted[0] = 0.5 + (cycle % 200 < 100 ? 0.4 : 0.0);
      pumps.swash[0] += follows ? 0.01 / 0.15 * (pumps.wanted[0] - pumps.swash[0]) : 0.0;
      farthest = std::max(farthest, std::abs(pumps.swash[0] - pumps.wanted[0]));
      disagreed = pumps.disagree(0.01) || disagreed;
    }
    assert_true(farthest > 2.0 * kTolerance);
    assert_int_equal(disagreed, !follows);
  }
}

/// Of a pump whose swash nobody measures the flow is reckoned with the least that it may have.
TEST(the_slower_of_both_stands_in, Pumps pumps) {
  pumps.profile.bus.swash_feedback = false;
  pumps.wanted = {0.25, 1.0};
  assert_false(pumps.disagree(0.05));
  pumps.assert_flow_with(0.25, kWanted[1] + 0.2 * (1.0 - kWanted[1]));
}
