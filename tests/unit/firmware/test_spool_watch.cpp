// SPDX-License-Identifier: Apache-2.0
#include "firmware/drives/spool_watch.hpp"

#include <algorithm>
#include <cmath>

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/watched_valve.hpp"

using test::spools_centred;
using namespace test::valve;

TEST(a_spool_at_its_duty_is_well) {
  for (const double duty : {0.0, 0.75, -0.75, 1.0, -1.0}) {
    Valve valve;
    valve.settle(duty);
  }
}

/// The tolerance itself is within; the next number beyond it is not. Both sides, each axis. Open
/// less than it should be it may yet come.
TEST(the_tolerance_is_a_sharp_edge) {
  for (unsigned axis = 0; axis < kAxisCount; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      Valve valve;
      valve.settle(0.5);
      // The side that the duty came from is left as a lag leaves it.
      valve.valid.drive[axis].spool_ratio = 0.5 + sign * kTolerance;
      assert_int_equal(valve.cycles_until(Fault::kSpoolStuck), -1);
      valve.valid.drive[axis].spool_ratio = 0.5 + sign * (kTolerance + 1e-9);
      assert_int_equal(valve.cycles_until(Fault::kSpoolStuck),
                       kSpoolWrongCycles + (sign < 0.0 ? kSpoolBehindCycles : 0));
    }
  }
}

/// One frame that is wrong, twice seen because frames come every second cycle, is not enough.
TEST(it_must_be_wrong_in_a_row, Valve valve) {
  valve.settle(0.0);
  for (int round = 0; round < 5; ++round) {
    valve.valid.drive[1].spool_ratio = 0.5;
    for (int n = 1; n < kSpoolWrongCycles; ++n) {
      assert_false(valve.stuck());
    }
    valve.valid.drive[1].spool_ratio = 0.0;
    assert_false(valve.stuck());
  }
  valve.valid.drive[1].spool_ratio = 0.5;
  assert_int_equal(valve.cycles_until(Fault::kSpoolStuck), kSpoolWrongCycles);
  // For as long as it lasts, and not a cycle longer.
  repeat(100, [&] { assert_true(valve.stuck()); });
  valve.valid.drive[1].spool_ratio = 0.0;
  assert_false(valve.stuck());
}

/// Axes do not add up: each spool has its own row.
TEST(each_spool_is_counted_by_itself, Valve valve) {
  valve.settle(0.0);
  for (int n = 0; n < 30; ++n) {
    all_at(valve.valid, 0.0);
    valve.valid.drive[static_cast<unsigned>(n % 3)].spool_ratio = 0.5;
    assert_false(valve.stuck());
  }
}

/// A spool that stays open against a close: wrong from the first cycle in which the slowest one
/// that is sound has gone beyond the tolerance.
TEST(it_is_given_the_time_to_settle) {
  for (const double open : {0.75, -0.75}) {
    Valve valve;
    valve.close_from(open);
    assert_int_equal(valve.cycles_until(Fault::kSpoolStuck), cycles_to_find(kStarts, 0.75));
  }
}

/// The dead time is known within 30 %: 1.3 * 0.15 s + 0.03 s + 0.02 s are 24.5 cycles.
TEST(it_is_given_the_dead_time_too, Valve valve) {
  valve.profile.control.dead_time_s = 0.15;
  valve.close_from(0.75);
  assert_int_equal(valve.cycles_until(Fault::kSpoolStuck), cycles_to_find(25, 0.75));
}

/// Of two sides the later one counts, and one that says that it is slow has the time it needs: two
/// lags of 1.3 * 0.07 s, or of half of what its drive lags.
TEST(it_is_given_what_its_slower_side_needs) {
  for (const bool extends : {true, false}) {
    Valve valve;
    for (SaidAnswers& answer : valve.profile.valve.answer) {
      answer.side(extends).dead_time_s = 0.15;
    }
    valve.close_from(0.75);
    assert_int_equal(valve.cycles_until(Fault::kSpoolStuck), cycles_to_find(25, 0.75));
    const auto settle_s = [&](double SaidAnswer::*time, double time_s) {
      ExcavatorProfile profile = valve.profile;
      profile.valve.answer[kBoom].side(extends).*time = time_s;
      const ExcavatorBank bank = excavator_bank(profile);
      assert_near(bank.row[kArm].watch.settle_s, profile.safety.settle_s, 0.0);
      return bank.row[kBoom].watch.settle_s;
    };
    assert_near(settle_s(&SaidAnswer::spool_time_constant_s, 0.07), 1.3 * 0.07 / 0.35, 1e-12);
    assert_near(settle_s(&SaidAnswer::lag_s, 0.2), 0.1 / 0.35, 1e-12);
    // Quicker than the profile's slowest spool it is not taken for.
    assert_near(settle_s(&SaidAnswer::lag_s, 0.01), valve.profile.safety.settle_s, 0.0);
    assert_near(settle_s(&SaidAnswer::spool_time_constant_s, 0.0), valve.profile.safety.settle_s,
                0.0);
  }
}

/// More than the ring holds is cut to it; no time at all still leaves the age of a frame.
TEST(the_time_under_way_is_bounded, Valve slow) {
  slow.profile.control.dead_time_s = 5.0;
  slow.close_from(0.75);
  assert_int_equal(slow.cycles_until(Fault::kSpoolStuck),
                   cycles_to_find(CommandHistory::kMostCycles, 0.75));
  Valve quick;
  quick.profile.safety.settle_s = 0.0;
  quick.close_from(0.75);
  assert_int_equal(quick.cycles_until(Fault::kSpoolStuck), cycles_to_find(2, 0.75, 1.0));
}

/// Commands of every kind for a spool that starts late and follows with two lags.
struct SoundSpool {
  double lag_s = 0.0;
  int late_cycles = 0;
  std::array<double, 8> under_way{};
  double first = 0.0;
  double travel = 0.0;

  double after(double duty) {
    std::rotate(under_way.begin(), under_way.end() - 1, under_way.end());
    under_way[0] = duty;
    const double newest = lag_s > 0.0 ? 1.0 - std::exp(-0.01 / lag_s) : 1.0;
    first += newest * (under_way[static_cast<unsigned>(late_cycles)] - first);
    travel += newest * (first - travel);
    return travel;
  }
};

/// Steps across the dead band, ramps and jitter, 20 s of them.
double duty_at(int cycle) {
  const double step = (cycle / 17) % 3 == 0 ? 0.25 : -0.25;
  const double ramp = 0.75 * std::sin(0.02 * cycle);
  return std::clamp(ramp + step * ((cycle / 5) % 2 == 0 ? 1.0 : 0.2), -1.0, 1.0);
}

/// Whether the watch, with hardly a tolerance, ever takes that spool for a stuck one.
bool is_found(double lag_s, int late_cycles, double last_lag_s) {
  Valve valve;
  valve.profile.safety.spool_tolerance = 1e-9;
  SoundSpool spool{lag_s, late_cycles};
  for (int n = 0; n < 2000; ++n) {
    const double duty = duty_at(n);
    valve.sent.duty_ratio = {duty, 0.0, 0.0};
    spool.lag_s = n % 40 < 20 ? lag_s : last_lag_s;
    valve.valid.drive[0].spool_ratio = spool.after(duty);
    if (valve.stuck()) {
      return true;
    }
  }
  return false;
}

/// Whatever its lag up to the bound, constant or not, and however late up to it: no command makes a
/// sound spool look stuck. Nor one of twice the lag, which is slow; one that hardly comes is.
TEST(no_sound_spool_is_stuck) {
  for (const double lag_s : {0.0, 0.005, 0.015, 0.025, 0.035}) {
    for (int late = 0; late < kStarts; ++late) {
      assert_false(is_found(lag_s, late, lag_s));
      assert_false(is_found(lag_s, late, 0.035 - lag_s));
    }
  }
  assert_true(is_found(0.5, 0, 0.5));
}

/// From wherever the ring stands: a command counts for as long, across its end as well.
TEST(the_ring_has_no_seam) {
  for (int start = 0; start < CommandHistory::kMostCycles; ++start) {
    Valve valve;
    repeat(start, [&] { assert_false(valve.stuck()); });
    valve.sent.duty_ratio = {1.0, 1.0, 1.0};
    assert_false(valve.stuck());
    valve.sent.duty_ratio = {0.0, 0.0, 0.0};
    all_at(valve.valid, 1.0);
    assert_int_equal(valve.cycles_until(Fault::kSpoolStuck), cycles_to_find(kStarts, 1.0));
  }
}

/// On its way anywhere between the least and the most of late a spool is well.
TEST(between_old_and_new_is_well, Valve valve) {
  valve.settle(-0.5);
  valve.sent.duty_ratio = {0.75, 0.75, 0.75};
  for (int n = 0; n < kStarts + 2; ++n) {
    valve.valid.drive[0].spool_ratio = -0.5 + 1.25 * n / 10;
    valve.valid.drive[1].spool_ratio = -0.5 - kTolerance;
    valve.valid.drive[2].spool_ratio = 0.75 + kTolerance;
    assert_false(valve.stuck());
  }
}

/// Enable given and not confirmed, and confirmed though it was not given.
TEST(the_echo_is_compared_both_ways) {
  for (const bool told : {true, false}) {
    Valve valve;
    valve.sent.enable = told;
    valve.valid.valve_enabled = told;
    repeat(100, [&] { assert_false(valve.deaf()); });
    valve.valid.valve_enabled = !told;
    for (int n = 1; n < kEchoCycles; ++n) {
      assert_false(valve.deaf());
    }
    valve.valid.valve_enabled = told;
    assert_false(valve.deaf());
    valve.valid.valve_enabled = !told;
    assert_int_equal(valve.cycles_until(Fault::kValveNotFollowing), kEchoCycles);
    assert_true(valve.deaf());
    valve.valid.valve_enabled = told;
    assert_false(valve.deaf());
  }
}

/// Spools that were not received are not judged, and counting begins afresh with those that are;
/// what was sent meanwhile is remembered.
TEST(missing_feedback_is_not_judged, Valve valve) {
  valve.settle(0.75);
  valve.sent.enable = true;
  // On the other side: one that is behind on its own has more time than the echo.
  all_at(valve.valid, -0.5);
  for (int n = 1; n < kSpoolWrongCycles; ++n) {
    assert_true(valve.step().empty());
  }
  valve.valid.faults.add(Fault::kSpoolMissing);
  repeat(50, [&] { assert_true(valve.step().empty()); });
  valve.valid.faults = {};
  assert_int_equal(valve.cycles_until(Fault::kSpoolStuck), kSpoolWrongCycles);
  assert_int_equal(valve.cycles_until(Fault::kValveNotFollowing), kEchoCycles - kSpoolWrongCycles);

  Valve closing;
  closing.close_from(0.75);
  closing.valid.faults.add(Fault::kSpoolMissing);
  for (int n = 0; n < cycles_to_find(kStarts, 0.75) - kSpoolWrongCycles; ++n) {
    assert_true(closing.step().empty());
  }
  closing.valid.faults = {};
  assert_int_equal(closing.cycles_until(Fault::kSpoolStuck), kSpoolWrongCycles);
}

TEST(centred_is_within_the_tolerance) {
  const ExcavatorProfile profile = test::plain_machine();
  ExcavatorValid valid;
  assert_true(spools_centred(profile, valid));
  for (unsigned axis = 0; axis < kAxisCount; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      valid = {};
      valid.drive[axis].spool_ratio = sign * kTolerance;
      assert_true(spools_centred(profile, valid));
      valid.drive[axis].spool_ratio = std::nextafter(sign * kTolerance, sign * 9.0);
      assert_false(spools_centred(profile, valid));
    }
  }
}

/// A fast spool goes where the lead points, beyond where it is to be; without the lead it is stuck
/// there.
TEST(a_spool_may_follow_its_lead) {
  for (const bool leads : {true, false}) {
    Valve valve;
    valve.settle(0.25);
    valve.sent.lead_ratio = {leads ? 0.5 : 0.0, 0.0, 0.0};
    valve.valid.drive[kBoom].spool_ratio = 0.75;
    assert_int_equal(valve.cycles_until(Fault::kSpoolStuck), leads ? -1 : kSpoolWrongCycles);
  }
}

/// One that starts 0.25 s late, with two lags of 0.15 s, is sound where duties are tried, and only
/// there; one that stands is not.
TEST(the_slowest_spool_may_be_tried) {
  for (const bool tried : {true, false}) {
    Valve slow;
    slow.try_boom(tried);
    std::array<double, 2> lag{};
    bool stuck = false;
    for (int n = 0; n < 200; ++n) {
      lag[0] += (n < 25 ? 0.0 : 0.8 - lag[0]) / 16.0;
      lag[1] += (lag[0] - lag[1]) / 16.0;
      slow.valid.drive[kBoom].spool_ratio = lag[1];
      stuck = !slow.step().empty() || stuck;
    }
    assert_true(stuck != tried);
  }
  Valve stands;
  stands.try_boom();
  const int cycles = stands.cycles_until(Fault::kSpoolStuck);
  assert_true(cycles > 45 && cycles < 90);
  Valve valve;  // That is known to be slower still: it is given its own time.
  valve.profile.control.dead_time_s = 0.5;
  valve.try_boom();
  assert_true(valve.cycles_until(Fault::kSpoolStuck) > 65);
}
