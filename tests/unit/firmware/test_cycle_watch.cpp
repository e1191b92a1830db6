#include "firmware/safety/cycle_watch.hpp"

#include "tests/unit/cmocka_cpp.hpp"

namespace {

using namespace graben;

/// A controller that is called after so much time.
struct Clock {
  CycleState state;
  TimeUs now_us = -3 * kSecondUs;  // Any instant.
  CycleWatchResult seen;

  Clock() { after(0); }
  Fault after(TimeUs elapsed_us) {
    now_us += elapsed_us;
    seen = watch_cycle(state, now_us);
    state = seen.state;
    return seen.fault;
  }
};

/// Whatever the clock says: there is nothing that it could be late after.
void the_first_cycle_is_well(void**) {
  for (const TimeUs now_us : {TimeUs{0}, 1000 * kSecondUs, -1000 * kSecondUs}) {
    const CycleWatchResult seen = watch_cycle({}, now_us);
    assert_int_equal(seen.fault, Fault::kNone);
    assert_near(seen.elapsed_s, 0.0, 0.0);
    assert_near(seen.period_s, 0.0, 0.0);
    assert_int_equal(seen.state.last_us, now_us);
  }
}

void time_is_counted_from_the_last_cycle(void**) {
  Clock clock;
  assert_int_equal(clock.after(10 * kMillisecondUs), Fault::kNone);
  assert_near(clock.seen.elapsed_s, 0.010, 1e-15);
  assert_near(clock.seen.period_s, 0.010, 1e-15);
  assert_int_equal(clock.after(7 * kMillisecondUs), Fault::kNone);
  assert_near(clock.seen.elapsed_s, 0.007, 1e-15);
}

/// What may change by so much a second gets no more than two cycles; a clock that ran back, none.
void no_cycle_is_a_large_step(void**) {
  Clock clock;
  static_cast<void>(clock.after(40 * kMillisecondUs));
  assert_near(clock.seen.elapsed_s, 0.040, 1e-15);
  assert_near(clock.seen.period_s, 0.020, 1e-15);
  static_cast<void>(clock.after(10 * kSecondUs));
  assert_near(clock.seen.elapsed_s, 0.050, 1e-15);
  assert_near(clock.seen.period_s, 0.020, 1e-15);
  assert_int_equal(clock.after(-kSecondUs), Fault::kNone);
  assert_near(clock.seen.elapsed_s, 0.0, 0.0);
  assert_near(clock.seen.period_s, 0.0, 0.0);
}

void the_second_late_one_in_a_row_is_an_overrun(void**) {
  constexpr TimeUs kLate = 15 * kMillisecondUs + 1;
  Clock clock;
  for (int round = 0; round < 3; ++round) {
    assert_int_equal(clock.after(kLate), Fault::kNone);
    assert_int_equal(clock.after(kLate - 1), Fault::kNone);
  }
  assert_int_equal(clock.after(kLate), Fault::kNone);
  for (int n = 0; n < 5; ++n) {
    assert_int_equal(clock.after(kLate), Fault::kCycleOverrun);
  }
  assert_int_equal(clock.after(10 * kMillisecondUs), Fault::kNone);
  assert_int_equal(clock.after(kLate), Fault::kNone);
}

void a_long_gap_is_a_stall(void**) {
  Clock clock;
  assert_int_equal(clock.after(50 * kMillisecondUs), Fault::kNone);
  static_cast<void>(clock.after(10 * kMillisecondUs));
  assert_int_equal(clock.after(50 * kMillisecondUs + 1), Fault::kCycleStalled);
  // It counts as late as well, and is the graver of the two.
  assert_int_equal(clock.after(20 * kMillisecondUs), Fault::kCycleOverrun);
  assert_int_equal(clock.after(60 * kMillisecondUs), Fault::kCycleStalled);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_first_cycle_is_well),
      cmocka_unit_test(time_is_counted_from_the_last_cycle),
      cmocka_unit_test(no_cycle_is_a_large_step),
      cmocka_unit_test(the_second_late_one_in_a_row_is_an_overrun),
      cmocka_unit_test(a_long_gap_is_a_stall),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
