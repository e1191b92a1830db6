#include "firmware/drives/spool_watch.hpp"

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/excavator_steps.hpp"
#include "tests/unit/firmware/plain_machine.hpp"

namespace {

using namespace graben;
using test::spools_centred;

constexpr double kTolerance = 0.125;
/// 0.1 s to settle without a dead time, in cycles: a command still counts as under way in the last.
constexpr int kUnderWay = 10;

void all_at(ExcavatorValid& valid, double spool_ratio) {
  for (unsigned i = 0; i < kAxisCount; ++i) {
    valid.drive[i].spool_ratio = spool_ratio;
  }
}

/// A valve and what is sent to it, cycle by cycle. Its spools are where `measured` says.
struct Valve {
  ExcavatorProfile profile = test::plain_machine();
  test::SpoolWatch state;
  LastCommands<kDriveCount> sent;
  ExcavatorValid valid;

  /// Whether this cycle finds a spool stuck.
  bool stuck() { return step().has(Fault::kSpoolStuck); }
  /// Whether it finds that the valve side does not say what we say.
  bool deaf() { return step().has(Fault::kValveNotFollowing); }
  FaultSet step() { return test::watch_spools(profile, state, sent, valid); }
  /// Cycles until a fault, counting the one that has it; -1 if none comes.
  int cycles_until(Fault fault) {
    for (int n = 1; n <= 200; ++n) {
      if (step().has(fault)) {
        return n;
      }
    }
    return -1;
  }
  void settle(double duty) {
    sent.duty_ratio = {duty, duty, duty};
    all_at(valid, duty);
    for (int n = 0; n < CommandHistory::kMostCycles; ++n) {
      assert_false(stuck());
    }
  }
};

void a_spool_at_its_duty_is_well(void**) {
  for (const double duty : {0.0, 0.75, -0.75, 1.0, -1.0}) {
    Valve valve;
    valve.settle(duty);
  }
}

/// The tolerance itself is within; the next number beyond it is not. Both sides, each axis.
void the_tolerance_is_a_sharp_edge(void**) {
  for (unsigned axis = 0; axis < kAxisCount; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      Valve valve;
      valve.settle(0.5);
      valve.valid.drive[axis].spool_ratio = 0.5 + sign * kTolerance;
      assert_int_equal(valve.cycles_until(Fault::kSpoolStuck), -1);
      valve.valid.drive[axis].spool_ratio = std::nextafter(0.5 + sign * kTolerance, sign * 9.0);
      assert_int_equal(valve.cycles_until(Fault::kSpoolStuck), kSpoolWrongCycles);
    }
  }
}

/// One frame that is wrong, twice seen because frames come every second cycle, is not enough.
void it_must_be_wrong_in_a_row(void**) {
  Valve valve;
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
  for (int n = 0; n < 100; ++n) {
    assert_true(valve.stuck());
  }
  valve.valid.drive[1].spool_ratio = 0.0;
  assert_false(valve.stuck());
}

/// Axes do not add up: each spool has its own row.
void each_spool_is_counted_by_itself(void**) {
  Valve valve;
  valve.settle(0.0);
  for (int n = 0; n < 30; ++n) {
    all_at(valve.valid, 0.0);
    valve.valid.drive[static_cast<unsigned>(n % 3)].spool_ratio = 0.5;
    assert_false(valve.stuck());
  }
}

/// A spool that stays open against a close: wrong from the first cycle in which no command of the
/// time under way has it open.
void it_is_given_the_time_to_settle(void**) {
  for (const double open : {0.75, -0.75}) {
    Valve valve;
    valve.settle(open);
    valve.sent.duty_ratio = {0.0, 0.0, 0.0};
    assert_int_equal(valve.cycles_until(Fault::kSpoolStuck), kUnderWay - 1 + kSpoolWrongCycles);
  }
}

/// The dead time is known within 30 %: 1.3 * 0.15 s + 0.1 s are 29.5 cycles.
void it_is_given_the_dead_time_too(void**) {
  Valve valve;
  valve.profile.control.dead_time_s = 0.15;
  valve.settle(0.75);
  valve.sent.duty_ratio = {0.0, 0.0, 0.0};
  assert_int_equal(valve.cycles_until(Fault::kSpoolStuck), 30 - 1 + kSpoolWrongCycles);
}

/// More than the ring holds is cut to it; no time at all still leaves the newest command.
void the_time_under_way_is_bounded(void**) {
  Valve slow;
  slow.profile.control.dead_time_s = 5.0;
  slow.settle(0.75);
  slow.sent.duty_ratio = {0.0, 0.0, 0.0};
  assert_int_equal(slow.cycles_until(Fault::kSpoolStuck),
                   CommandHistory::kMostCycles - 1 + kSpoolWrongCycles);
  Valve quick;
  quick.profile.safety.settle_s = 0.0;
  quick.settle(0.75);
  quick.sent.duty_ratio = {0.0, 0.0, 0.0};
  assert_int_equal(quick.cycles_until(Fault::kSpoolStuck), kSpoolWrongCycles);
}

/// From wherever the ring stands: a command counts for as long, across its end as well.
void the_ring_has_no_seam(void**) {
  for (int start = 0; start < CommandHistory::kMostCycles; ++start) {
    Valve valve;
    for (int n = 0; n < start; ++n) {
      assert_false(valve.stuck());
    }
    valve.sent.duty_ratio = {1.0, 1.0, 1.0};
    assert_false(valve.stuck());
    valve.sent.duty_ratio = {0.0, 0.0, 0.0};
    all_at(valve.valid, 1.0);
    assert_int_equal(valve.cycles_until(Fault::kSpoolStuck), kUnderWay - 1 + kSpoolWrongCycles);
  }
}

/// On its way anywhere between the least and the most of late a spool is well.
void between_old_and_new_is_well(void**) {
  Valve valve;
  valve.settle(-0.5);
  valve.sent.duty_ratio = {0.75, 0.75, 0.75};
  for (int n = 0; n < kUnderWay - 1; ++n) {
    valve.valid.drive[0].spool_ratio = -0.5 + 1.25 * n / kUnderWay;
    valve.valid.drive[1].spool_ratio = -0.5 - kTolerance;
    valve.valid.drive[2].spool_ratio = 0.75 + kTolerance;
    assert_false(valve.stuck());
  }
}

/// Enable given and not confirmed, and confirmed though it was not given.
void the_echo_is_compared_both_ways(void**) {
  for (const bool told : {true, false}) {
    Valve valve;
    valve.sent.enable = told;
    valve.valid.valve_enabled = told;
    for (int n = 0; n < 100; ++n) {
      assert_false(valve.deaf());
    }
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
void missing_feedback_is_not_judged(void**) {
  Valve valve;
  valve.settle(0.75);
  valve.sent.enable = true;
  all_at(valve.valid, 0.0);
  for (int n = 1; n < kSpoolWrongCycles; ++n) {
    assert_true(valve.step().empty());
  }
  valve.valid.faults.add(Fault::kSpoolMissing);
  for (int n = 0; n < 50; ++n) {
    assert_true(valve.step().empty());
  }
  valve.valid.faults = {};
  assert_int_equal(valve.cycles_until(Fault::kSpoolStuck), kSpoolWrongCycles);
  assert_int_equal(valve.cycles_until(Fault::kValveNotFollowing), kEchoCycles - kSpoolWrongCycles);

  Valve closing;
  closing.settle(0.75);
  closing.sent.duty_ratio = {0.0, 0.0, 0.0};
  closing.valid.faults.add(Fault::kSpoolMissing);
  for (int n = 0; n < kUnderWay - 1; ++n) {
    assert_true(closing.step().empty());
  }
  closing.valid.faults = {};
  assert_int_equal(closing.cycles_until(Fault::kSpoolStuck), kSpoolWrongCycles);
}

void centred_is_within_the_tolerance(void**) {
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

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_spool_at_its_duty_is_well),
      cmocka_unit_test(the_tolerance_is_a_sharp_edge),
      cmocka_unit_test(it_must_be_wrong_in_a_row),
      cmocka_unit_test(each_spool_is_counted_by_itself),
      cmocka_unit_test(it_is_given_the_time_to_settle),
      cmocka_unit_test(it_is_given_the_dead_time_too),
      cmocka_unit_test(the_time_under_way_is_bounded),
      cmocka_unit_test(the_ring_has_no_seam),
      cmocka_unit_test(between_old_and_new_is_well),
      cmocka_unit_test(the_echo_is_compared_both_ways),
      cmocka_unit_test(missing_feedback_is_not_judged),
      cmocka_unit_test(centred_is_within_the_tolerance),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
