// SPDX-License-Identifier: Apache-2.0
#include "firmware/drives/blocked.hpp"

#include <array>

#include "tests/unit/cmocka_cpp.hpp"

constexpr double kPeriod_s = 0.01;
constexpr double kRelief_pa = 32e6;
constexpr double kLine_pa = 30e6;
/// Enough of both, but less than is let off.
constexpr double kPush_pa = 0.85 * kLine_pa;
constexpr double kAsked_mps = 0.1;
constexpr double kWanted_mps = 0.04;

/// One drive; what it shows and is asked for is set by the test.
struct Drive {
  DriveRow row;
  ValidDrive seen;
  BlockedState state;
  double way = 1.0;
  double asked_mps = kAsked_mps;
  double line_pa = kLine_pa;
  double speed_mps = 0.0;

  Drive() {
    row.watch.relief_pa = kRelief_pa;
    seen.load_known = true;
    seen.stroke_m = 0.5;
  }
  void push(double pressure_pa) {
    (way > 0.0 ? seen.cap_pressure_pa : seen.rod_pressure_pa) = pressure_pa;
  }
  void step() {
    seen.stroke_m += kPeriod_s * speed_mps;
    const double towards_mps = way * kAsked_mps;
    const double now_mps = way * asked_mps;
    next_blocked({&row, 1}, {&seen, 1}, {{&towards_mps, 1}, {&now_mps, 1}, {&line_pa, 1}},
                 kPeriod_s, {&state, 1});
  }
  /// Cycles until it is blocked, or is no longer; -1 if it does not come.
  int until(bool blocked, int most = 400) {
    for (int n = 1; n <= most; ++n) {
      step();
      if ((state.side != 0) == blocked) {
        return n;
      }
    }
    return -1;
  }
  int until(Easing easing) {
    for (int n = 1; n <= 400; ++n) {
      step();
      if (state.easing == easing) {
        return n;
      }
    }
    return -1;
  }
};

Drive blocked_drive(double pressure_pa, double way = 1.0) {
  Drive drive;
  drive.way = way;
  drive.push(pressure_pa);
  assert_true(drive.until(true) > 0);
  return drive;
}

/// Either way, within half a second of the pressure, and told as what holds the machine.
TEST(what_strains_and_stands_is_blocked) {
  for (const double way : {1.0, -1.0}) {
    Drive drive;
    drive.way = way;
    drive.push(kPush_pa);
    const int cycles = drive.until(true);
    assert_in_range(cycles, 20, 60);
    assert_int_equal(drive.state.side, static_cast<int>(way));
    assert_true(any_blocked({&drive.state, 1}));
    assert_int_equal(blocked_limit({&drive.state, 1}).kind, LimitKind::kBackFlow);
  }
  const BlockedState free;
  assert_false(any_blocked({&free, 1}));
  assert_int_equal(blocked_limit({&free, 1}).kind, LimitKind::kNone);
}

/// A stroke that stands at less pressure may be a stuck sensor; one that moves is not held; without
/// pressures, a line or a way to go nothing is known.
TEST(what_only_stands_or_only_strains_is_not, Drive weak) {
  weak.push(0.76 * kLine_pa);
  assert_int_equal(weak.until(true), -1);
  assert_false(weak.state.strains);
  Drive moves;
  moves.push(0.9 * kLine_pa);
  moves.speed_mps = 0.25 * kAsked_mps;
  Drive lifts;
  lifts.line_pa = 20e6;
  lifts.push(20e6);
  assert_int_equal(lifts.until(true), -1);
  assert_false(lifts.state.strains);
  assert_int_equal(moves.until(true), -1);
  assert_true(moves.state.strains);
  Drive unknown;
  unknown.push(kLine_pa);
  unknown.seen.load_known = false;
  assert_int_equal(unknown.until(true), -1);
  Drive no_line;
  no_line.push(kLine_pa);
  no_line.line_pa = 0.0;
  assert_int_equal(no_line.until(true), -1);
  Drive at_rest;
  at_rest.push(kLine_pa);
  at_rest.way = 0.0;
  assert_int_equal(at_rest.until(true), -1);
  Drive wrong_side;
  wrong_side.seen.rod_pressure_pa = kLine_pa;
  assert_int_equal(wrong_side.until(true), -1);
}

/// With lambda at 0 nothing is asked of the spools, and it is held all the same.
TEST(lambda_at_0_hides_nothing, Drive drive) {
  drive.asked_mps = 0.0;
  drive.push(0.9 * kLine_pa);
  assert_true(drive.until(true) > 0);
  Drive creeps;
  creeps.asked_mps = 0.0;
  creeps.speed_mps = 0.002;
  creeps.push(0.9 * kLine_pa);
  assert_int_equal(creeps.until(true), -1);
}

/// It gets on again: the pressure falls, it moves, or it is to go back.
TEST(it_ends_with_what_made_it) {
  Drive eased = blocked_drive(kPush_pa);
  eased.push(0.76 * kLine_pa);
  assert_int_equal(eased.until(false, 100), -1);
  eased.push(0.5 * kLine_pa);
  assert_in_range(eased.until(false), 1, 30);
  Drive moves = blocked_drive(kPush_pa);
  moves.speed_mps = kAsked_mps;
  assert_in_range(moves.until(false), 1, 20);
  Drive back = blocked_drive(kPush_pa);
  back.way = -1.0;
  assert_int_equal(back.until(false), 1);
}

/// What feedback adds to that side goes within 0.3 s and comes back as slowly; what it adds to the
/// other side, and what is wanted, stay.
TEST(feedback_is_eased_and_comes_back) {
  for (const double way : {1.0, -1.0}) {
    Drive drive = blocked_drive(kPush_pa, way);
    assert_near(eased_mps(drive.state, way * kWanted_mps, way * kAsked_mps), way * kAsked_mps,
                0.06 / 30.0 + 1e-12);
    repeat(30, [&] { drive.step(); });
    assert_near(eased_mps(drive.state, way * kWanted_mps, way * kAsked_mps), way * kWanted_mps,
                1e-12);
    assert_near(eased_mps(drive.state, -way * kWanted_mps, way * kAsked_mps), 0.0, 1e-12);
    assert_near(eased_mps(drive.state, way * kWanted_mps, -way * kAsked_mps), -way * kAsked_mps,
                0.0);
    drive.push(0.0);
    assert_true(drive.until(false) > 0);
    double last_mps = eased_mps(drive.state, way * kWanted_mps, way * kAsked_mps);
    for (int n = 0; n < 30; ++n) {
      drive.step();
      const double now_mps = eased_mps(drive.state, way * kWanted_mps, way * kAsked_mps);
      assert_true(way * (now_mps - last_mps) <= 0.06 / 30.0 + 1e-12);
      last_mps = now_mps;
    }
    assert_near(last_mps, way * kAsked_mps, 1e-12);
  }
}

/// A tenth of a second at the relief's pressure: it lets off, rests on what is left, and pushes
/// again.
TEST(at_the_relief_it_lets_off) {
  Drive drive = blocked_drive(0.95 * kRelief_pa);
  assert_in_range(drive.until(Easing::kLetsOff), 8, 12);
  assert_true(any_eases({&drive.state, 1}));
  assert_near(eased_mps(drive.state, kWanted_mps, kAsked_mps), -0.03, 1e-12);
  drive.push(0.4 * kRelief_pa);
  assert_in_range(drive.until(Easing::kRests), 1, 20);
  assert_near(eased_mps(drive.state, kWanted_mps, kAsked_mps), 0.0, 1e-12);
  assert_near(eased_mps(drive.state, kWanted_mps, -kAsked_mps), -kAsked_mps, 1e-12);
  assert_int_equal(drive.state.side, 1);
  assert_in_range(drive.until(false), 298, 302);
  assert_true(drive.state.easing == Easing::kPushes);
  assert_false(any_eases({&drive.state, 1}));
}

/// Once it has let off, its load may give way at any time: until it has gone 20 mm past the place,
/// or for 6 s after it was blocked last.
TEST(it_stays_wary_until_it_is_past) {
  for (const double way : {1.0, -1.0}) {
    Drive drive = blocked_drive(0.95 * kRelief_pa, way);
    assert_false(any_wary({&drive.state, 1}));
    assert_true(drive.until(Easing::kRests) > 0);
    assert_true(any_wary({&drive.state, 1}));
    drive.push(0.0);
    assert_true(drive.until(false) > 0);
    Drive waits = drive;
    drive.seen.stroke_m += way * 0.019;
    drive.step();
    assert_true(any_wary({&drive.state, 1}));
    drive.seen.stroke_m += way * 0.002;
    drive.step();
    assert_false(any_wary({&drive.state, 1}));
    repeat(590, [&] { waits.step(); });
    assert_true(any_wary({&waits.state, 1}));
    repeat(15, [&] { waits.step(); });
    assert_false(any_wary({&waits.state, 1}));
  }
}

/// Letting off takes a second at most; a pressure below 0.85 of the relief's is kept. Where no
/// relief is known nothing is.
TEST(it_lets_off_only_what_is_hard) {
  Drive stays = blocked_drive(0.95 * kRelief_pa);
  assert_true(stays.until(Easing::kLetsOff) > 0);
  assert_in_range(stays.until(Easing::kRests), 98, 102);
  Drive soft = blocked_drive(0.82 * kRelief_pa);
  assert_int_equal(soft.until(Easing::kLetsOff), -1);
  Drive unknown;
  unknown.row.watch.relief_pa = 0.0;
  unknown.push(0.95 * kRelief_pa);
  assert_int_equal(unknown.until(true), -1);
}

/// What has let off rests short of its load; there it counts from where it began to rest.
TEST(what_has_let_off_is_given_way_to_from_where_it_rests, Drive drive) {
  drive = blocked_drive(0.95 * kRelief_pa);
  assert_true(drive.until(Easing::kLetsOff) > 0);
  drive.speed_mps = -0.03;
  repeat(30, [&] { drive.step(); });
  drive.speed_mps = 0.0;
  drive.push(0.4 * kRelief_pa);
  assert_true(drive.until(Easing::kRests) > 0);
  drive.seen.stroke_m += 0.0045;
  drive.step();
  assert_true(drive.state.side != 0);
  drive.seen.stroke_m += 0.001;
  drive.step();
  assert_int_equal(drive.state.side, 0);
}

/// A load that gives way throws the drive: known in the cycle in which it has gone 5 mm.
TEST(giving_way_is_known_at_once) {
  for (const double way : {1.0, -1.0}) {
    for (const Easing easing : {Easing::kLetsOff, Easing::kRests}) {
      Drive drive = blocked_drive(0.95 * kRelief_pa, way);
      assert_true(drive.until(easing) > 0);
      drive.seen.stroke_m += way * 0.0045;
      drive.step();
      assert_true(drive.state.side != 0);
      drive.seen.stroke_m += way * 0.001;
      drive.step();
      assert_int_equal(drive.state.side, 0);
      assert_true(drive.state.less > 0.3);
    }
  }
}

/// The least rest of all that ease; one that only pushes does not count.
TEST(how_long_all_have_rested) {
  std::array<BlockedState, 3> state{};
  const Span<const BlockedState> all(state.data(), 3);
  assert_near(rested_s(all), 0.0, 0.0);
  state[0] = blocked_drive(kPush_pa).state;
  assert_near(rested_s(all), 0.0, 0.0);
  for (const unsigned k : {1U, 2U}) {
    state[k].side = 1;
    state[k].easing = Easing::kRests;
    state[k].for_s = 0.5 * k;
  }
  assert_near(rested_s(all), 0.5, 0.0);
  state[1].easing = Easing::kLetsOff;
  assert_near(rested_s(all), 0.0, 0.0);
}
