// SPDX-License-Identifier: Apache-2.0
// Three wrong frames of the last sixteen are a fault, of one message and of one kind.

#include "hal/link/e2e_window.hpp"
#include "tests/unit/cmocka_cpp.hpp"

constexpr TimeUs kCycleUs = 10'000;

struct Watch {
  E2eWindow window;
  TimeUs now = 5 * kSecondUs;

  void note(E2eMark mark, int count = 1) {
    for (int i = 0; i < count; ++i) {
      now += kCycleUs;
      e2e_note(window, mark, now);
    }
  }
  Fault fault() const {
    const FaultSet faults = e2e_faults(window, now);
    assert_int_equal(faults.after(faults.first()), Fault::kNone);
    return faults.first();
  }
};

struct Kind {
  E2eMark mark;
  Fault fault;
};
constexpr Kind kKinds[] = {{E2eMark::kSequence, Fault::kMessageSequence},
                           {E2eMark::kCorrupt, Fault::kMessageCorrupt},
                           {E2eMark::kMasquerade, Fault::kMessageMasquerade}};

TEST(three_of_a_kind_are_a_fault) {
  for (const Kind& kind : kKinds) {
    Watch watch;
    assert_int_equal(watch.fault(), Fault::kNone);
    watch.note(E2eMark::kGood, 20);
    assert_int_equal(watch.fault(), Fault::kNone);
    watch.note(kind.mark, 2);
    assert_int_equal(watch.fault(), Fault::kNone);
    watch.note(kind.mark);
    assert_int_equal(watch.fault(), kind.fault);
    watch.note(kind.mark, 13);  // all of the window
    assert_int_equal(watch.fault(), kind.fault);
  }
}

TEST(sixteen_frames_are_the_window) {
  for (const Kind& kind : kKinds) {
    Watch watch;
    watch.note(kind.mark, 2);
    watch.note(E2eMark::kGood, 13);
    watch.note(kind.mark);  // the first is the 16th from here
    assert_int_equal(watch.fault(), kind.fault);
    watch.note(E2eMark::kGood);
    assert_int_equal(watch.fault(), Fault::kNone);
    // So good frames end a fault.
    watch.note(kind.mark, 16);
    watch.note(E2eMark::kGood, 13);
    assert_int_equal(watch.fault(), kind.fault);
    watch.note(E2eMark::kGood);
    assert_int_equal(watch.fault(), Fault::kNone);
  }
}

TEST(kinds_are_counted_apart, Watch watch) {
  watch.note(E2eMark::kSequence, 2);
  watch.note(E2eMark::kCorrupt, 2);
  assert_int_equal(watch.fault(), Fault::kNone);
  watch.note(E2eMark::kSequence);
  watch.note(E2eMark::kCorrupt);
  const FaultSet both = e2e_faults(watch.window, watch.now);
  assert_true(both.has(Fault::kMessageSequence));
  assert_true(both.has(Fault::kMessageCorrupt));
  assert_false(both.has(Fault::kMessageMasquerade));
}

// A CRC that fits another message is a wrong CRC all the same.
TEST(masquerades_are_corrupt_too, Watch watch) {
  watch.note(E2eMark::kMasquerade, 2);
  watch.note(E2eMark::kCorrupt);
  assert_int_equal(watch.fault(), Fault::kMessageCorrupt);
  watch.note(E2eMark::kMasquerade);
  assert_int_equal(watch.fault(), Fault::kMessageMasquerade);
}

TEST(a_second_without_frames_empties_it, Watch watch) {
  watch.note(E2eMark::kCorrupt, 3);
  watch.now += kE2eWindowForget_us;
  assert_int_equal(watch.fault(), Fault::kMessageCorrupt);
  watch.now += 1;
  assert_int_equal(watch.fault(), Fault::kNone);
  watch.note(E2eMark::kCorrupt, 2);
  assert_int_equal(watch.fault(), Fault::kNone);

  Watch just_in_time;
  just_in_time.note(E2eMark::kCorrupt, 2);
  just_in_time.now += kE2eWindowForget_us - kCycleUs;
  just_in_time.note(E2eMark::kCorrupt);
  assert_int_equal(just_in_time.fault(), Fault::kMessageCorrupt);
}
