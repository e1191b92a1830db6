// SPDX-License-Identifier: Apache-2.0
#include "firmware/drives/motion_watch.hpp"

#include <cmath>
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/excavator_steps.hpp"
#include "tests/unit/firmware/plain_machine.hpp"
#include "tests/unit/firmware/two_sides.hpp"

constexpr double kPeriod_s = 0.0625;   // Eight of them are the time to settle, to the last bit.
constexpr double kAllowed_m = 0.0625;  // safety.uncommanded and safety.stuck
constexpr double kOpen = 0.75;         // Duty; a spool begins to open at 0.25.
constexpr double kRest_m = 0.5;

double beyond(double value, double towards) { return std::nextafter(value, towards * 9.0); }

/// One cylinder and its spool; the two others rest.
struct Cylinder {
  unsigned axis = 0;
  std::array<MotionState, kDriveCount> state{};
  double stroke_m = kRest_m;
  double spool = 0.0;
  double asked_mps = 0.0;

  FaultSet step(double period_s = kPeriod_s) {
    const ExcavatorBank bank = excavator_bank(test::plain_machine());
    std::array<ValidDrive, kDriveCount> seen;
    for (ValidDrive& drive : seen) {
      drive.stroke_m = kRest_m;
    }
    seen[axis].stroke_m = stroke_m;
    seen[axis].spool_ratio = spool;
    std::array<double, kDriveCount> asked{};
    asked[axis] = asked_mps;
    return watch_motion(bank.rows(), seen, asked, period_s, state);
  }
  bool uncommanded(double period_s = kPeriod_s) {
    return step(period_s).has(Fault::kUncommandedMotion);
  }
  bool stuck() { return step().has(Fault::kStrokeStuck); }
  /// At rest until the time to settle is over.
  void settle() {
    repeat(20, [&] { assert_true(step().empty()); });
  }
};

Cylinder settled(double spool, unsigned axis = 0) {
  Cylinder cylinder;
  cylinder.axis = axis;
  cylinder.spool = spool;
  cylinder.settle();
  return cylinder;
}

/// Closed: so far it may go, either way, and not a bit further. No time passes, so nothing is
/// forgotten.
TEST(a_closed_spool_holds_its_cylinder) {
  for (unsigned axis = 0; axis < kAxisCount; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      Cylinder cylinder = settled(0.0, axis);
      cylinder.stroke_m = kRest_m + sign * kAllowed_m;
      assert_false(cylinder.uncommanded(0.0));
      cylinder.stroke_m = beyond(cylinder.stroke_m, sign);
      assert_true(cylinder.uncommanded(0.0));
    }
  }
}

/// Within its deadband a spool is closed: a cylinder that runs then does so by itself. Within 3 %
/// of the travel before its end it may be open.
TEST(the_deadband_is_closed) {
  for (const double sign : {1.0, -1.0}) {
    for (const double opens : {0.219, 0.221, 0.25}) {
      Cylinder with = settled(sign * opens);
      with.stroke_m = kRest_m + sign * 0.25;
      assert_true(with.uncommanded() == (opens < 0.22));
      Cylinder against = settled(sign * opens);
      against.stroke_m = kRest_m - sign * 0.25;
      assert_true(against.uncommanded());
    }
  }
}

/// Open: with the spool as far as it likes, against it so far and no further, counted from the
/// furthest that it had come.
TEST(an_open_spool_leads_its_cylinder) {
  for (const double sign : {1.0, -1.0}) {
    Cylinder cylinder = settled(sign * kOpen);
    for (int n = 1; n <= 4; ++n) {
      cylinder.stroke_m = kRest_m + sign * 0.125 * n;
      assert_false(cylinder.uncommanded());
    }
    cylinder.stroke_m = kRest_m + sign * (0.5 - kAllowed_m);
    assert_false(cylinder.uncommanded(0.0));
    cylinder.stroke_m = beyond(cylinder.stroke_m, -sign);
    assert_true(cylinder.uncommanded(0.0));
  }
}

/// 0.5 s after a spool has closed, opened or turned round, whatever happens is the old oil's.
TEST(oil_may_ring_down) {
  const double ways[][2] = {{kOpen, 0.0},  {-kOpen, 0.0},   {0.0, kOpen},
                            {0.0, -kOpen}, {kOpen, -kOpen}, {-kOpen, kOpen}};
  for (const auto& way : ways) {
    Cylinder cylinder = settled(way[0]);
    cylinder.spool = way[1];
    for (int n = 0; n < 8; ++n) {  // The change itself, and 7 periods: less than 0.5 s.
      cylinder.stroke_m = kRest_m + (n % 2 == 0 ? 0.25 : -0.25);
      assert_false(cylinder.uncommanded());
    }
    const double against = way[1] > 0.0 ? -1.0 : 1.0;
    cylinder.stroke_m += against * 0.125;
    assert_true(cylinder.uncommanded());  // 0.5 s are over.
  }
}

/// The time begins again with each change.
TEST(each_change_settles_anew) {
  Cylinder cylinder = settled(kOpen);
  for (int change = 0; change < 6; ++change) {
    cylinder.spool = change % 2 == 0 ? 0.0 : kOpen;
    for (int n = 0; n < 8; ++n) {
      cylinder.stroke_m = cylinder.stroke_m > kRest_m ? 0.25 : 0.75;
      assert_false(cylinder.uncommanded());
    }
  }
}

/// A leak of 5 mm/s is no uncommanded motion over any distance; 20 mm/s are.
TEST(leakage_is_forgotten) {
  Cylinder leaking = settled(0.0);
  Cylinder sinking = settled(0.0);
  bool sunk = false;
  for (int n = 0; n < 1600; ++n) {  // 100 s
    leaking.stroke_m -= 0.005 * kPeriod_s;
    assert_false(leaking.uncommanded());
    sinking.stroke_m -= 0.020 * kPeriod_s;
    sunk = sunk || sinking.uncommanded();
  }
  assert_true(sunk);
}

/// 50 mm twice: too much within a second, forgotten after a minute.
TEST(forgetting_takes_seconds) {
  for (const bool soon : {true, false}) {
    Cylinder cylinder = settled(0.0);
    cylinder.stroke_m += 0.05;
    repeat((soon ? 16 : 960), [&] { assert_false(cylinder.uncommanded()); });
    cylinder.stroke_m += 0.05;
    assert_int_equal(cylinder.uncommanded(), soon);
  }
  // However long a cycle: no further than to where the cylinder is.
  Cylinder cylinder = settled(0.0);
  cylinder.stroke_m += 0.125;
  assert_false(cylinder.uncommanded(30.0));
  cylinder.stroke_m -= 0.05;
  assert_false(cylinder.uncommanded(0.0));
}

/// Asked for 0.125 m/s: 8 cycles are what is allowed, the ninth is too much.
TEST(a_stroke_that_stands_still_is_stuck) {
  for (unsigned axis = 0; axis < kAxisCount; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      Cylinder cylinder = settled(sign * kOpen, axis);
      cylinder.asked_mps = sign * 0.125;
      repeat(8, [&] { assert_false(cylinder.stuck()); });
      assert_true(cylinder.stuck());
      assert_true(cylinder.stuck());
      cylinder.stroke_m += sign * 0.002;
      assert_false(cylinder.stuck());
    }
  }
}

/// Closed, open the other way, or nothing asked: it may well stand still.
TEST(only_what_is_asked_and_led_can_be_stuck) {
  const double rows[][2] = {{0.0, 0.125},    {0.0, -0.125}, {kOpen, -0.125},
                            {-kOpen, 0.125}, {kOpen, 0.0},  {-kOpen, 0.0}};
  for (const auto& row : rows) {
    Cylinder cylinder = settled(row[0]);
    cylinder.asked_mps = row[1];
    repeat(100, [&] { assert_false(cylinder.stuck()); });
  }
}

/// Half a millimetre is within what a sensor at rest may say, more is motion.
TEST(noise_is_no_motion) {
  for (const bool moves : {false, true}) {
    Cylinder cylinder;
    cylinder.stroke_m = 0.0;  // Where the watch begins: the difference is exact.
    cylinder.spool = kOpen;
    cylinder.asked_mps = 0.5;  // Two cycles are what is allowed.
    assert_true(cylinder.step().empty());
    assert_true(cylinder.step().empty());
    cylinder.stroke_m = moves ? beyond(0.0005, 1.0) : 0.0005;
    assert_int_equal(cylinder.stuck(), !moves);
  }
  // A slow one, 0.2 mm a cycle, has moved after three.
  Cylinder slow = settled(kOpen);
  slow.asked_mps = 0.125;
  for (int n = 0; n < 1000; ++n) {
    slow.stroke_m += 0.0002;
    assert_false(slow.stuck());
  }
}

/// What was asked before a pause counts on: no flow came of it either way.
TEST(what_was_asked_adds_up) {
  Cylinder cylinder = settled(kOpen);
  for (int n = 0; n < 8; ++n) {
    cylinder.asked_mps = 0.125;
    assert_false(cylinder.stuck());
    cylinder.asked_mps = 0.0;
    assert_false(cylinder.stuck());
  }
  cylinder.asked_mps = 0.125;
  assert_true(cylinder.stuck());
}

/// Seconds until a stroke that does not move, spool open, counts as stuck; 600 if it never does.
double stuck_after_s(double asked_mps) {
  DriveRow row;
  const double ends[] = {0.2, 1.0};
  assert_int_equal(row.answer.extend.spool_to_duty.fill(ends, ends, 2), MonotoneTable::Fill::kOk);
  row.answer.retract = row.answer.extend;
  row.watch.uncommanded_m = 0.02;
  row.watch.stuck_m = 0.03;
  row.watch.rest_s = kCylinderRest_s;
  ValidDrive seen;
  seen.stroke_m = 0.1;
  seen.spool_ratio = asked_mps > 0.0 ? 0.4 : -0.4;
  MotionState state;
  for (int n = 1; n <= 60000; ++n) {
    if (watch_motion({&row, 1}, {&seen, 1}, {&asked_mps, 1}, 0.01, {&state, 1})
            .has(Fault::kStrokeStuck)) {
      return n * 0.01;
    }
  }
  return 600.0;
}

TEST(what_is_asked_for_and_does_not_come_is_stuck) {
  assert_near(stuck_after_s(0.1), 0.3, 0.03);
  assert_near(stuck_after_s(-0.02), 1.6, 0.1);
}

/// A blade on level ground is asked for what leaks, for minutes.
TEST(held_against_leakage_it_is_not_stuck) {
  assert_near(stuck_after_s(0.0005), 600.0, 0.0);
  assert_near(stuck_after_s(-0.0025), 600.0, 0.0);
}

/// A stroke that stands still is stuck where its side is open.
TEST(each_side_has_its_own_dead_band) {
  for (const double spool_ratio : {0.35, -0.35}) {
    DriveRow row;
    row.answer = test::two_sides();
    row.watch.uncommanded_m = 0.02;
    row.watch.stuck_m = 0.03;
    ValidDrive seen;
    seen.spool_ratio = spool_ratio;
    const double asked_mps = 0.1 * spool_ratio;
    MotionState state;
    bool stuck = false;
    for (int n = 0; n < 200; ++n) {
      stuck = stuck || watch_motion({&row, 1}, {&seen, 1}, {&asked_mps, 1}, 0.01, {&state, 1})
                           .has(Fault::kStrokeStuck);
    }
    assert_true(stuck == (spool_ratio < 0.0));
  }
}
