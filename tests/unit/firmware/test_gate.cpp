// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <limits>

#include "firmware/drives/drive_gate.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/excavator_steps.hpp"
#include "tests/unit/firmware/plain_machine.hpp"
#include "tests/unit/firmware/two_sides.hpp"

using test::gate;
using test::Gated;
using test::GateState;

constexpr double kLong_s = 1.0;  // Longer than any rate limit needs.

const ExcavatorProfile& profile() {
  static const ExcavatorProfile machine = test::plain_machine();
  return machine;
}
double travel() { return profile().valve.spool_travel_m; }

TEST(duty_follows_the_profiles_table) {
  const Gated result = gate(profile(), {}, true, {travel(), -0.5 * travel(), 0.0}, kLong_s);
  assert_true(result.enable);
  assert_near(result.duty_ratio[0], 1.0, 1e-12);
  assert_near(result.duty_ratio[1], -0.625, 1e-12);  // 0.25 .. 1
  assert_near(result.duty_ratio[2], 0.0, 0.0);
}

/// A machine without a swing drive has no fourth spool, whatever is asked of one.
TEST(a_drive_that_is_not_there_stays_neutral) {
  const Gated result = gate(profile(), {}, true, {0.0, 0.0, travel(), travel()}, kLong_s);
  assert_true(result.enable);
  assert_near(result.duty_ratio[2], 1.0, 1e-12);
  assert_near(result.duty_ratio[3], 0.0, 0.0);
}

/// A bank may be shorter than what its drives are kept in: the rest is neither read nor written.
TEST(nothing_behind_the_last_drive_is_touched) {
  const ExcavatorBank bank = excavator_bank(profile());
  const DriveRows two{bank.rows().begin(), 2};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::array<double, 3> spool_m = {travel(), travel(), nan};
  std::array<double, 3> opening = {0.0, 0.0, 6.0};
  std::array<double, 3> wanted_ratio = {0.0, 0.0, nan};
  open_spools(two, spool_m, kLong_s, opening, wanted_ratio);
  assert_near(opening[2], 6.0, 0.0);
  assert_true(std::isnan(wanted_ratio[2]));
  std::array<double, 3> sent = {0.0, 0.0, 5.0};
  std::array<double, 3> duty_ratio = {0.0, 0.0, 7.0};
  const GateResult result = gate_duties(two, true, wanted_ratio, kLong_s, sent, duty_ratio);
  assert_true(result.enable);
  assert_int_equal(result.fault, Fault::kNone);
  assert_near(duty_ratio[1], 1.0, 1e-12);
  assert_near(duty_ratio[2], 7.0, 0.0);
  assert_near(sent[2], 5.0, 0.0);
}

TEST(a_spool_hardly_open_stays_neutral) {
  const double threshold = profile().control.spool_threshold;
  for (const double sign : {1.0, -1.0}) {
    const double edge_m = sign * threshold * travel();
    const Gated below = gate(profile(), {}, true, {std::nextafter(edge_m, 0.0), 0.0, 0.0}, kLong_s);
    assert_true(below.enable);
    assert_near(below.duty_ratio[0], 0.0, 0.0);
    const Gated at = gate(profile(), {}, true, {edge_m, 0.0, 0.0}, kLong_s);
    assert_near(at.duty_ratio[0], sign * (0.25 + 0.75 * threshold), 1e-12);
  }
}

TEST(positions_beyond_the_travel_are_clamped) {
  const Gated result = gate(profile(), {}, true, {9.0 * travel(), -9.0 * travel(), 0.0}, kLong_s);
  assert_near(result.duty_ratio[0], 1.0, 1e-12);
  assert_near(result.duty_ratio[1], -1.0, 1e-12);
  assert_near(result.state.opening[0], 1.0, 0.0);
  assert_near(result.state.opening[1], -1.0, 0.0);
}

// Whatever the table says, a valve is driven neither beyond its range nor the other way.
TEST(duties_beyond_the_range_are_clamped) {
  ExcavatorProfile wild = profile();
  const double opening[] = {0.0, 1.0};
  const double duty[] = {-1.0, 2.0};
  assert_int_equal(wild.valve.spool_to_duty.fill(opening, duty, 2), MonotoneTable::Fill::kOk);
  const Gated result = gate(wild, {}, true, {travel(), -travel(), 0.25 * travel()}, kLong_s);
  assert_near(result.duty_ratio[0], 1.0, 0.0);
  assert_near(result.duty_ratio[1], -1.0, 0.0);
  assert_near(result.duty_ratio[2], 0.0, 0.0);
}

TEST(changes_are_limited_in_rate) {
  const double step = profile().control.spool_rate_ps * 0.01;
  const Gated first = gate(profile(), {}, true, {travel(), 0.0, 0.0}, 0.01);
  assert_near(first.state.opening[0], step, 1e-12);
  const Gated second = gate(profile(), first.state, true, {travel(), 0.0, 0.0}, 0.01);
  assert_near(second.state.opening[0], 2.0 * step, 1e-12);
  // No time, or a clock that ran back: not a bit further open.
  for (const double period_s : {0.0, -1.0}) {
    const Gated still = gate(profile(), first.state, true, {travel(), 0.0, 0.0}, period_s);
    assert_near(still.state.opening[0], step, 1e-12);
  }
  const Gated other_way = gate(profile(), {}, true, {-travel(), 0.0, 0.0}, 0.01);
  assert_near(other_way.state.opening[0], -step, 1e-12);
}

/// Towards neutral a spool goes at once; a reversal opens from neutral.
TEST(closing_is_never_delayed, GateState open) {
  open.opening = {1.0, -1.0, 1.0};
  const double step = profile().control.spool_rate_ps * 0.01;
  const Gated result = gate(profile(), open, true, {0.1 * travel(), 0.0, -travel()}, 0.01);
  assert_near(result.state.opening[0], 0.1, 1e-12);
  assert_near(result.state.opening[1], 0.0, 0.0);
  assert_near(result.duty_ratio[1], 0.0, 0.0);
  assert_near(result.state.opening[2], -step, 1e-12);
  const Gated back = gate(profile(), open, true, {0.0, travel(), -0.1 * travel()}, 0.01);
  assert_near(back.state.opening[0], 0.0, 0.0);
  assert_near(back.state.opening[1], step, 1e-12);
  assert_near(back.state.opening[2], -step, 1e-12);
}

/// However little it is open: what is open may stay, the other side may not open.
TEST(the_least_opening_has_its_side) {
  constexpr double kLeast = 1e-200;  // The square of it is 0.
  GateState open;
  open.opening = {kLeast, -kLeast, kLeast};
  const double further_m = 2.0 * kLeast * travel();
  const Gated result = gate(profile(), open, true, {further_m, -further_m, -further_m}, 0.0);
  assert_near(result.state.opening[0] / kLeast, 1.0, 0.0);
  assert_near(result.state.opening[1] / kLeast, -1.0, 0.0);
  assert_near(result.state.opening[2] / kLeast, 0.0, 0.0);
}

/// A spool that is to be closed has duty 0, whatever the threshold.
TEST(closed_is_duty_zero) {
  ExcavatorProfile keen = profile();
  keen.control.spool_threshold = 0.0;
  const Gated result = gate(keen, {}, true, {0.0, -0.0, 0.0}, 0.01);
  for (const double duty : result.duty_ratio) {
    assert_near(duty, 0.0, 0.0);
  }
}

/// Neutral knows no rate: not active closes everything in the same cycle.
TEST(not_active_is_neutral_at_once, GateState open) {
  open.sent = {1.0, -1.0, 0.5};
  const Gated result = gate(profile(), open, false, {travel(), travel(), travel()}, 0.01);
  assert_false(result.enable);
  for (unsigned i = 0; i < kAxisCount; ++i) {
    assert_near(result.duty_ratio[i], 0.0, 0.0);
    assert_near(result.state.sent[i], 0.0, 0.0);
  }
}

TEST(what_is_no_number_is_refused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinity, -infinity}) {
    for (unsigned i = 0; i < kAxisCount; ++i) {
      std::array<double, kDriveCount> spool = {travel(), travel(), travel(), 0.0};
      spool[i] = bad;
      const Gated result = gate(profile(), {}, true, spool, 0.01);
      assert_false(result.enable);
      assert_int_equal(result.fault, Fault::kCommandNotFinite);
      for (const double duty : result.duty_ratio) {
        assert_near(duty, 0.0, 0.0);
      }
    }
  }
  for (const double bad_s : {infinity, nan}) {
    const Gated timeless = gate(profile(), {}, true, {0.0, 0.0, 0.0}, bad_s);
    assert_int_equal(timeless.enable, std::isnan(bad_s));  // No time: nothing opens.
  }
}

struct Wire {
  ExcavatorBank bank = excavator_bank(profile());
  std::array<double, kDriveCount> sent{};
  std::array<double, kDriveCount> duty_ratio{};

  GateResult step(const std::array<double, kDriveCount>& wanted, double period_s = kLong_s,
                  bool active = true) {
    return gate_duties(bank.rows(), active, wanted, period_s, sent, duty_ratio);
  }
};

/// The gate knows no table and no threshold.
TEST(duties_pass_as_they_are, Wire wire) {
  const GateResult result = wire.step({0.001, -0.1, 0.9, 0.9});
  assert_true(result.enable);
  assert_int_equal(result.fault, Fault::kNone);
  assert_near(wire.duty_ratio[0], 0.001, 0.0);
  assert_near(wire.duty_ratio[1], -0.1, 0.0);
  assert_near(wire.duty_ratio[2], 0.9, 0.0);
  assert_near(wire.sent[2], 0.9, 0.0);
  assert_near(wire.duty_ratio[3], 0.0, 0.0);
  assert_true(wire.step({2.0, -2.0, 0.0}).enable);
  assert_near(wire.duty_ratio[0], 1.0, 0.0);
  assert_near(wire.duty_ratio[1], -1.0, 0.0);
  assert_near(wire.duty_ratio[2], 0.0, 0.0);
}

/// Whatever made them, up by no more than the profile's rate; down at once, through zero as from
/// zero; with no time, or a clock that ran back, not a bit further.
TEST(duties_rise_by_the_profiles_rate, Wire wire) {
  wire.bank.row[1].control.duty_rate_ps = 20.0;
  static_cast<void>(wire.step({0.9, -0.9, 0.2}, 0.01));
  assert_near(wire.duty_ratio[0], 0.01 * kDutyRate_ps, 1e-12);
  assert_near(wire.duty_ratio[1], -0.2, 1e-12);
  assert_near(wire.duty_ratio[2], 0.2, 0.0);
  static_cast<void>(wire.step({0.9, -0.9, -0.9}, 0.01));
  assert_near(wire.duty_ratio[0], 0.9, 1e-12);
  assert_near(wire.duty_ratio[1], -0.4, 1e-12);
  assert_near(wire.duty_ratio[2], -0.01 * kDutyRate_ps, 1e-12);
  for (const double period_s : {0.0, -1.0}) {
    static_cast<void>(wire.step({0.0, -0.9, -0.9}, period_s));
    assert_near(wire.duty_ratio[0], 0.0, 0.0);
    assert_near(wire.duty_ratio[1], -0.4, 1e-12);
    assert_near(wire.duty_ratio[2], -0.01 * kDutyRate_ps, 1e-12);
  }
}

/// A quarter a cycle, so that a step is one; down at once, through zero as from zero.
TEST(duties_that_are_tried_may_step, Wire wire) {
  const auto stepped = [&wire](const std::array<double, kDriveCount>& tried, double period_s) {
    std::array<double, kDriveCount> duty_ratio{};
    step_duties(wire.bank.rows(), tried, period_s, wire.sent, duty_ratio);
    assert_near(duty_ratio[3], 0.0, 0.0);
    assert_true(wire.step(duty_ratio).enable);
  };
  stepped({0.6, -0.6, 0.2, 0.9}, 0.01);
  assert_near(wire.duty_ratio[0], 0.25, 1e-12);
  assert_near(wire.duty_ratio[1], -0.25, 1e-12);
  assert_near(wire.duty_ratio[2], 0.2, 0.0);
  stepped({0.6, -0.6, -0.9}, 0.01);
  assert_near(wire.duty_ratio[0], 0.5, 1e-12);
  assert_near(wire.duty_ratio[2], -0.25, 1e-12);
  stepped({0.0, -0.6, 0.0}, -1.0);
  assert_near(wire.duty_ratio[0], 0.0, 0.0);
  assert_near(wire.duty_ratio[1], -0.5, 1e-12);
}

TEST(not_active_closes_what_is_sent, Wire passive) {
  passive.duty_ratio.fill(0.5);
  assert_false(passive.step({0.5, 0.5, 0.5}, kLong_s, false).enable);
  assert_near(passive.duty_ratio[0], 0.0, 0.0);
}

TEST(a_duty_that_is_no_number_is_refused) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), infinity, -infinity}) {
    Wire wrong;
    const GateResult refused = wrong.step({0.5, bad, 0.0});
    assert_false(refused.enable);
    assert_int_equal(refused.fault, Fault::kCommandNotFinite);
    assert_near(wrong.duty_ratio[0], 0.0, 0.0);
  }
  Wire timeless;
  assert_int_equal(timeless.step({0.5, 0.5, 0.5}, infinity).fault, Fault::kCommandNotFinite);
}

/// Duties of one drive by its two tables; the others keep to the whole valve's.
TEST(each_side_has_its_own_table) {
  ExcavatorProfile two = profile();
  const SpoolAnswers answer = test::two_sides();
  two.valve.answer[kBoom].extend.spool_to_duty = answer.extend.spool_to_duty;
  two.valve.answer[kArm].retract.spool_to_duty = answer.extend.spool_to_duty;
  const auto duty = [&](double share, unsigned drive) {
    std::array<double, kDriveCount> spool_m{};
    spool_m[drive] = share * travel();
    return gate(two, {}, true, spool_m, kLong_s).duty_ratio[drive];
  };
  assert_near(duty(0.25, 0), 0.5, 1e-12);
  assert_near(duty(-0.25, 0), -0.4375, 1e-12);
  assert_near(duty(0.25, 1), 0.4375, 1e-12);
  assert_near(duty(-0.25, 1), -0.5, 1e-12);
  assert_near(duty(0.625, 0), 0.75, 1e-12);
  assert_near(duty(0.25, 2), 0.4375, 1e-12);
}
