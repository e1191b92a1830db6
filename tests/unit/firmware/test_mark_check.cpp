// SPDX-License-Identifier: Apache-2.0
// The tool at its mark: what is taken, what is refused, what lets nothing arm.

#include "firmware/safety/mark_check.hpp"

#include <cmath>
#include <limits>

#include "tests/unit/cmocka_cpp.hpp"

constexpr double kCycle_s = 0.0078125;  // A power of two: times are exact.
constexpr int kRestCycles = 64;         // 0.5 s of them.
constexpr double kTolerance_m = 0.03125;

/// A machine in the operator's hands.
struct Marked {
  MarkProfile mark{{6.0, 0.0, 0.0}, kTolerance_m, 0.0, false};
  MarkSeen seen{false, 0, true, true, true, Eigen::Vector3d::Zero()};
  MarkState state;

  void run(int cycles) {
    repeat(cycles, [this] { next_mark(mark, seen, kCycle_s, state); });
  }
  /// A second of touch `number`, and the time after it.
  const MarkTold& touch(std::uint8_t number) {
    seen.touched = true;
    seen.number = number;
    run(128);
    seen.touched = false;
    run(1);
    return state.told;
  }
  const MarkTold& rest_and_touch(std::uint8_t number) {
    run(kRestCycles + 1);
    return touch(number);
  }
  [[nodiscard]] CommonValid told(bool moving = false) const {
    CommonValid valid;
    tell_mark(mark, state, moving, valid);
    return valid;
  }
};

TEST(without_a_mark_there_is_nothing_to_say, Marked machine) {
  machine.mark = {};
  machine.seen.off_m = {1.0, 0.0, 0.0};
  const MarkTold& told = machine.rest_and_touch(1);
  assert_int_equal(told.result, MarkResult::kNoMark);
  assert_int_equal(told.touch, MarkTouch::kNoPoint);
  assert_near(told.age_s, 0.0, 0.0);
  assert_true(machine.told().faults.empty() && machine.told().warned.empty());
}

TEST(after_the_start_no_check_was_made, Marked machine) {
  machine.run(2);
  assert_int_equal(machine.state.told.result, MarkResult::kNever);
  assert_near(machine.state.told.tolerance_m, kTolerance_m, 0.0);
  assert_int_equal(machine.state.told.count, 0);
  assert_int_equal(machine.told().fault, Fault::kNone);
  assert_true(machine.told().warned.empty());
}

TEST(a_touch_within_the_tolerance_passes_and_ages, Marked machine) {
  machine.seen.off_m = {0.0, 0.0, -kTolerance_m};
  const MarkTold& told = machine.rest_and_touch(7);
  assert_int_equal(told.touch, MarkTouch::kTaken);
  assert_int_equal(told.result, MarkResult::kPassed);
  assert_near(told.off_m.z(), -kTolerance_m, 0.0);
  assert_near(told.age_s, 128 * kCycle_s, 0.0);
  assert_int_equal(machine.told().fault, Fault::kNone);
}

TEST(beyond_it_nothing_arms_until_a_check_passes, Marked machine) {
  machine.seen.off_m = {0.0, 0.0, std::nextafter(kTolerance_m, 1.0)};
  static_cast<void>(machine.rest_and_touch(7));
  assert_int_equal(machine.state.told.result, MarkResult::kMissed);
  assert_int_equal(machine.told().fault, Fault::kMarkMissed);
  assert_true(machine.told().faults.has(Fault::kMarkMissed));
  assert_int_equal(machine.told(true).fault, Fault::kMarkMissed);
  machine.seen.off_m.z() = 0.0;
  static_cast<void>(machine.rest_and_touch(8));
  assert_int_equal(machine.told().fault, Fault::kNone);
  assert_int_equal(machine.state.told.count, 2);
}

TEST(each_way_counts_alone_and_together, Marked machine) {
  const double share = kTolerance_m / std::sqrt(3.0);
  machine.seen.off_m = {share, -share, 0.99 * share};
  assert_int_equal(machine.rest_and_touch(1).result, MarkResult::kPassed);
  machine.seen.off_m = {share, -share, 1.01 * share};
  assert_int_equal(machine.rest_and_touch(2).result, MarkResult::kMissed);
}

TEST(a_touch_counts_once_and_each_number_is_a_touch, Marked machine) {
  assert_int_equal(machine.rest_and_touch(0).count, 1);
  assert_int_equal(machine.touch(0).count, 2);  // The same after a silence.
  machine.seen.touched = true;
  machine.seen.number = 1;
  machine.run(3);
  machine.seen.number = 2;
  machine.run(3);
  assert_int_equal(machine.state.told.count, 4);
  for (int i = 0; i < 300; ++i) {
    machine.seen.number = static_cast<std::uint8_t>(3 + i % 2);
    machine.run(1);
  }
  assert_int_equal(machine.state.told.count, 250);
}

TEST(what_moves_is_refused_and_the_last_check_stays, Marked machine) {
  static_cast<void>(machine.rest_and_touch(1));
  machine.seen.off_m.x() = 0.0051;
  const MarkTold& told = machine.touch(2);
  assert_int_equal(told.touch, MarkTouch::kMoving);
  assert_int_equal(told.result, MarkResult::kPassed);
  assert_int_equal(told.count, 1);
  assert_near(told.off_m.x(), 0.0, 0.0);
}

TEST(it_rests_after_half_a_second_within_5_mm, Marked machine) {
  machine.run(1);
  machine.seen.off_m.x() = 0.005;  // Within.
  machine.run(kRestCycles - 3);
  machine.seen.touched = true;
  machine.run(1);  // The last one that is too early.
  machine.seen.number = 1;
  assert_int_equal(machine.state.told.touch, MarkTouch::kMoving);
  machine.run(1);
  assert_int_equal(machine.state.told.touch, MarkTouch::kTaken);
  machine.seen.off_m.x() = 0.0;
  machine.seen.number = 2;
  machine.run(1);
  assert_int_equal(machine.state.told.touch, MarkTouch::kTaken);
}

TEST(spools_off_their_middle_move, Marked machine) {
  machine.seen.at_rest = false;
  assert_int_equal(machine.rest_and_touch(1).touch, MarkTouch::kMoving);
}

TEST(what_is_not_the_operators_or_not_known_is_refused, Marked machine) {
  machine.seen.by_hand = false;
  machine.seen.known = false;
  assert_int_equal(machine.rest_and_touch(1).touch, MarkTouch::kNotByHand);
  machine.seen.by_hand = true;
  assert_int_equal(machine.touch(2).touch, MarkTouch::kNotKnown);
  assert_int_equal(machine.state.told.result, MarkResult::kNever);
  machine.seen.known = true;
  machine.seen.off_m.x() = std::numeric_limits<double>::quiet_NaN();
  assert_int_equal(machine.rest_and_touch(3).touch, MarkTouch::kMoving);
}

TEST(an_old_check_is_said_and_stops_only_where_it_is_required, Marked machine) {
  machine.mark.most_age_s = 4.0;
  assert_true(machine.told().warned.has(Fault::kMarkDue));
  static_cast<void>(machine.rest_and_touch(1));  // Now 1 s old.
  assert_true(machine.told().warned.empty());
  machine.run(3 * 128);
  assert_near(machine.state.told.age_s, 4.0, 0.0);
  assert_true(machine.told().warned.empty());
  machine.run(1);
  assert_true(machine.told().warned.has(Fault::kMarkDue));
  assert_int_equal(machine.told().fault, Fault::kNone);
  machine.mark.required = true;
  assert_int_equal(machine.told().fault, Fault::kMarkDue);
  assert_int_equal(machine.told(true).fault, Fault::kNone);
  assert_true(machine.told(true).warned.has(Fault::kMarkDue));
  static_cast<void>(machine.touch(2));
  assert_int_equal(machine.told().fault, Fault::kNone);
}

TEST(one_that_missed_ages_too, Marked machine) {
  machine.mark.most_age_s = 2.0;
  machine.seen.off_m.x() = 1.0;
  static_cast<void>(machine.rest_and_touch(1));
  assert_true(machine.told().warned.empty());
  machine.run(200);
  assert_true(machine.told().warned.has(Fault::kMarkDue));
  assert_int_equal(machine.told().fault, Fault::kMarkMissed);
}

TEST(a_touch_is_said_for_three_of_its_periods) {
  const TimeUs now_us = 5 * kSecondUs;
  for (const TimeUs age_us : {TimeUs{0}, 300 * kMillisecondUs, 300 * kMillisecondUs + 1}) {
    MarkSeen seen;
    read_touch({{9, TouchKind::kSurface}, Validity::kValid, now_us - age_us}, now_us, seen);
    assert_int_equal(seen.touched, age_us <= 300 * kMillisecondUs);
    assert_int_equal(seen.number, 9);
    assert_int_equal(seen.kind, TouchKind::kSurface);
  }
  MarkSeen seen;
  read_touch({}, now_us, seen);
  assert_false(seen.touched);
}

TEST(any_other_fault_makes_the_place_unknown) {
  FaultSet faults;
  assert_true(is_place_known(faults));
  faults.add(Fault::kMarkMissed);
  faults.add(Fault::kMarkDue);
  assert_true(is_place_known(faults));
  faults.add(Fault::kStrokeMissing);
  assert_false(is_place_known(faults));
}

/// Of a point of the site: whoever knows it is asked, the mark's check stays what it was.
TEST(another_point_is_no_check, Marked machine) {
  machine.rest_and_touch(1);
  machine.seen.kind = TouchKind::kHeading;
  machine.seen.off_m = {0.0, 0.0, 1.0};
  machine.run(kRestCycles + 1);
  machine.seen.touched = true;
  machine.seen.number = 2;
  assert_true(next_mark(machine.mark, machine.seen, kCycle_s, machine.state));
  assert_false(next_mark(machine.mark, machine.seen, kCycle_s, machine.state));
  assert_int_equal(machine.state.told.touch, MarkTouch::kNoPoint);
  assert_int_equal(machine.state.told.result, MarkResult::kPassed);
  assert_int_equal(machine.state.told.count, 1);
  machine.seen.kind = TouchKind::kMark;
  machine.seen.number = 3;
  assert_false(next_mark(machine.mark, machine.seen, kCycle_s, machine.state));
  assert_int_equal(machine.state.told.result, MarkResult::kMissed);
  // Refused ones are nobody's.
  machine.seen.kind = TouchKind::kBenchmark;
  machine.seen.by_hand = false;
  machine.seen.number = 4;
  assert_false(next_mark(machine.mark, machine.seen, kCycle_s, machine.state));
  assert_int_equal(machine.state.told.touch, MarkTouch::kNotByHand);
  // Tracks that have moved need neither hand nor rest.
  machine.seen.kind = TouchKind::kMoved;
  machine.seen.known = false;
  machine.seen.at_rest = false;
  machine.seen.number = 5;
  assert_true(next_mark(machine.mark, machine.seen, kCycle_s, machine.state));
}
