// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/safety/dozer_gate.hpp"

#include <cmath>
#include <limits>

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/plain_dozer.hpp"

constexpr double kLong_s = 1.0;  // Longer than any rate limit needs.
constexpr double kStep_s = 0.0625;
constexpr double kPumpStep = 0.25;    // 4/s
constexpr double kMotorStep = 0.125;  // 2/s
constexpr double kSpoolStep = 0.1953125;

const DozerProfile& profile() {
  static const DozerProfile machine = test::plain_dozer();
  return machine;
}

/// The result with the state after it.
struct Gated : DozerGateResult {
  DozerGateState state;
};

Gated gate(const DozerProfile& machine, const DozerGateState& last, bool active,
           const DozerCommand& wanted, double period_s) {
  const DozerBank bank = dozer_bank(machine);
  Gated gated;
  gated.state = last;
  static_cast<DozerGateResult&>(gated) =
      gate_dozer(machine, bank.rows(), active, wanted, period_s, gated.state);
  return gated;
}

DozerGateState at(double opening, double pump, double motor) {
  DozerGateState state;
  state.opening = {opening};
  state.duty_ratio = {std::copysign(0.25 + 0.75 * std::abs(opening), opening)};
  state.pump_ratio = {pump, pump};
  state.motor_ratio = {motor, motor};
  return state;
}

Gated let(const DozerCommand& wanted, const DozerGateState& last, double period_s) {
  return gate(profile(), last, true, wanted, period_s);
}

void assert_neutral(const Gated& result) {
  assert_false(result.enable);
  assert_near(result.duty_ratio[0], 0.0, 0.0);
  assert_near(result.state.opening[0], 0.0, 0.0);
  for (unsigned i = 0; i < kTrackCount; ++i) {
    assert_near(result.pump_ratio[i], 0.0, 0.0);
    assert_near(result.motor_ratio[i], 1.0, 0.0);
    assert_near(result.state.pump_ratio[i], 0.0, 0.0);
    assert_near(result.state.motor_ratio[i], 1.0, 0.0);
  }
}

TEST(what_is_wanted_goes_through) {
  const Gated result = let({{-0.5}, {0.75, -0.25}, {1.0, 0.5}}, {}, kLong_s);
  assert_true(result.enable);
  assert_int_equal(result.fault, Fault::kNone);
  assert_near(result.duty_ratio[0], -0.625, 1e-12);  // 0.25 .. 1
  assert_near(result.pump_ratio[kLeft], 0.75, 0.0);
  assert_near(result.pump_ratio[kRight], -0.25, 0.0);
  assert_near(result.motor_ratio[kLeft], 1.0, 0.0);
  assert_near(result.motor_ratio[kRight], 0.5, 0.0);
  assert_near(result.state.opening[0], -0.5, 0.0);
  assert_near(result.state.pump_ratio[kRight], -0.25, 0.0);
  assert_near(result.state.motor_ratio[kRight], 0.5, 0.0);
}

TEST(what_is_out_of_range_is_clamped) {
  for (const double sign : {1.0, -1.0}) {
    const Gated result = let({{sign * 9.0}, {sign * 9.0, -sign * 9.0}, {-9.0, 9.0}}, {}, kLong_s);
    assert_near(result.duty_ratio[0], sign, 1e-12);
    assert_near(result.pump_ratio[kLeft], sign, 0.0);
    assert_near(result.pump_ratio[kRight], -sign, 0.0);
    assert_near(result.motor_ratio[kLeft], 0.25, 0.0);
    assert_near(result.motor_ratio[kRight], 1.0, 0.0);
  }
}

TEST(a_spool_hardly_open_stays_neutral) {
  const double threshold = profile().control.spool_threshold;
  for (const double sign : {1.0, -1.0}) {
    const double edge = sign * threshold;
    assert_near(let({{std::nextafter(edge, 0.0)}}, {}, kLong_s).duty_ratio[0], 0.0, 0.0);
    assert_near(let({{edge}}, {}, kLong_s).duty_ratio[0], sign * (0.25 + 0.75 * threshold), 1e-12);
  }
}

TEST(the_way_from_neutral_is_limited) {
  for (const double sign : {1.0, -1.0}) {
    const DozerCommand all{{sign}, {sign, sign}, {0.25, 0.25}};
    DozerGateState last;
    for (int n = 1; n <= 3; ++n) {
      last = let(all, last, kStep_s).state;
      assert_near(last.opening[0], sign * n * kSpoolStep, 1e-12);
      for (unsigned i = 0; i < kTrackCount; ++i) {
        assert_near(last.pump_ratio[i], sign * n * kPumpStep, 0.0);
        assert_near(last.motor_ratio[i], 1.0 - n * kMotorStep, 0.0);
      }
    }
    // No time, or a clock that ran back: not a bit further.
    for (const double period_s : {0.0, -1.0}) {
      const Gated still = let(all, last, period_s);
      assert_near(still.state.opening[0], last.opening[0], 0.0);
      assert_near(still.pump_ratio[kLeft], last.pump_ratio[kLeft], 0.0);
      assert_near(still.motor_ratio[kRight], last.motor_ratio[kRight], 0.0);
    }
  }
}

/// Towards neutral everything goes at once; a reversal begins there.
TEST(the_way_back_is_never_delayed) {
  for (const double sign : {1.0, -1.0}) {
    const DozerGateState fast = at(sign, sign, 0.25);
    const Gated slower = let({{0.5 * sign}, {0.0, 0.5 * sign}, {0.5, 1.0}}, fast, kStep_s);
    assert_near(slower.state.opening[0], 0.5 * sign, 0.0);
    assert_near(slower.pump_ratio[kLeft], 0.0, 0.0);
    assert_near(slower.pump_ratio[kRight], 0.5 * sign, 0.0);
    assert_near(slower.motor_ratio[kLeft], 0.5, 0.0);
    assert_near(slower.motor_ratio[kRight], 1.0, 0.0);
    const Gated back = let({{-sign}, {-sign, -0.125 * sign}, {0.25, 0.25}}, fast, kStep_s);
    assert_near(back.state.opening[0], -sign * kSpoolStep, 1e-12);
    assert_near(back.pump_ratio[kLeft], -sign * kPumpStep, 0.0);
    assert_near(back.pump_ratio[kRight], -0.125 * sign, 0.0);
    assert_near(back.motor_ratio[kLeft], 0.25, 0.0);
  }
}

/// Neutral knows no rate: not active stops everything in the same cycle.
TEST(not_active_is_neutral_at_once) {
  const Gated result =
      gate(profile(), at(1.0, -1.0, 0.25), false, {{1.0}, {1.0, 1.0}, {0.25, 0.25}}, kStep_s);
  assert_int_equal(result.fault, Fault::kNone);
  assert_neutral(result);
}

TEST(what_is_no_number_is_refused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinity, -infinity}) {
    const DozerCommand commands[] = {{{bad}, {0.5, 0.5}, {1.0, 1.0}},
                                     {{0.5}, {bad, 0.5}, {1.0, 1.0}},
                                     {{0.5}, {0.5, bad}, {1.0, 1.0}},
                                     {{0.5}, {0.5, 0.5}, {bad, 1.0}},
                                     {{0.5}, {0.5, 0.5}, {1.0, bad}}};
    for (const DozerCommand& command : commands) {
      const Gated result = let(command, at(0.5, 0.5, 0.5), kStep_s);
      assert_int_equal(result.fault, Fault::kCommandNotFinite);
      assert_neutral(result);
    }
  }
}

/// Each rate limit by itself; and the time, of which only one that is no number is none.
TEST(a_limit_that_is_no_number_is_refused) {
  const double infinity = std::numeric_limits<double>::infinity();
  double* (*const rates[])(DozerProfile&) = {
      [](DozerProfile& wild) { return &wild.control.spool_rate_ps; },
      [](DozerProfile& wild) { return &wild.control.duty_rate_ps; },
      [](DozerProfile& wild) { return &wild.hst.pump_rate_ps; },
      [](DozerProfile& wild) { return &wild.hst.motor_rate_ps; }};
  for (const auto& rate : rates) {
    DozerProfile wild = profile();
    *rate(wild) = infinity;
    const Gated result = gate(wild, {}, true, {}, kStep_s);
    assert_int_equal(result.fault, Fault::kCommandNotFinite);
    assert_neutral(result);
  }
  assert_neutral(let({}, {}, infinity));
  const Gated timeless =
      let({{1.0}, {1.0, 1.0}, {0.25, 0.25}}, {}, std::numeric_limits<double>::quiet_NaN());
  assert_true(timeless.enable);  // No time: nothing opens.
  assert_near(timeless.pump_ratio[kLeft], 0.0, 0.0);
  assert_near(timeless.motor_ratio[kLeft], 1.0, 0.0);
}

/// Duties that are tried go as they are, within 40 ms and their range; what is no number is sent as
/// nothing, whatever it is.
TEST(a_tried_duty_steps_and_leaves_no_opening) {
  DozerCommand wanted;
  wanted.tries = true;
  wanted.opening = {0.9};
  wanted.tried_ratio = {-0.5};
  const Gated tried = let(wanted, at(0.5, 0.0, 1.0), kLong_s);
  assert_int_equal(tried.fault, Fault::kNone);
  assert_near(tried.duty_ratio[0], -0.5, 0.0);
  assert_near(tried.state.opening[0], 0.0, 0.0);
  const Gated soon = let(wanted, {}, 0.01);
  assert_true(soon.duty_ratio[0] < -0.2 && soon.duty_ratio[0] > -0.5);
  wanted.tried_ratio = {7.0};
  assert_near(let(wanted, {}, kLong_s).duty_ratio[0], 1.0, 0.0);
  for (const double wrong :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (const bool tries : {true, false}) {
      wanted.tries = tries;
      wanted.tried_ratio = {wrong};
      const Gated none = let(wanted, at(0.5, 0.25, 0.5), kLong_s);
      assert_int_equal(none.fault, Fault::kCommandNotFinite);
      assert_neutral(none);
    }
  }
}
