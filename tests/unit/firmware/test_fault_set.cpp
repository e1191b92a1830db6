// SPDX-License-Identifier: Apache-2.0
#include "firmware/core/fault_set.hpp"

#include "tests/unit/cmocka_cpp.hpp"

TEST(it_begins_empty) {
  const FaultSet none;
  assert_true(none.empty());
  assert_int_equal(none.first(), Fault::kNone);
  for (int code = 0; code < kFaultCount; ++code) {
    assert_false(none.has(static_cast<Fault>(code)));
  }
}

TEST(each_fault_has_its_own_bit) {
  for (int code = 1; code < kFaultCount; ++code) {
    FaultSet one;
    one.add(static_cast<Fault>(code));
    assert_false(one.empty());
    assert_int_equal(one.first(), code);
    assert_int_equal(one.after(static_cast<Fault>(code)), Fault::kNone);
    for (int other = 0; other < kFaultCount; ++other) {
      assert_int_equal(one.has(static_cast<Fault>(other)), other == code);
    }
  }
}

TEST(none_is_never_in_it, FaultSet faults) {
  faults.add(Fault::kNone);
  assert_true(faults.empty());
  assert_false(faults.has(Fault::kNone));
}

/// A number beyond the last fault's may be in it, from a newer sender; nobody is told of it.
TEST(an_unknown_number_is_not_named, FaultSet faults) {
  faults.add(static_cast<Fault>(kFaultCount));
  assert_int_equal(faults.first(), Fault::kNone);
  assert_int_equal(faults.after(Fault::kSensorError), Fault::kNone);
}

/// Up to 127, in both words; those are numbers that the bus may get one day.
TEST(each_number_up_to_127_is_found) {
  constexpr int kAll = FaultSet::kNumbers;
  FaultSet all;
  for (int code = 1; code < kAll; ++code) {
    FaultSet one;
    one.add(static_cast<Fault>(code));
    all.add(one);
    assert_false(one.empty());
    assert_false(one == FaultSet{});
    assert_int_equal(one == all, code == 1);
    for (int from = 0; from < 256; ++from) {
      assert_int_equal(one.next(from, kAll), from < code ? code : 0);
      assert_int_equal(one.next(from, code), 0);
      assert_int_equal(one.has(static_cast<Fault>(from)), from == code);
    }
    one.remove(static_cast<Fault>(code));
    assert_true(one.empty());
  }
  for (int code = 0; code < kAll - 1; ++code) {
    assert_int_equal(all.next(code, kAll), code + 1);
  }
}

/// It has no place, and takes nobody else's.
TEST(a_number_from_128_on_is_not_kept, FaultSet faults) {
  for (int code = FaultSet::kNumbers; code < 256; ++code) {
    faults.add(static_cast<Fault>(code));
  }
  assert_true(faults.empty());
}

TEST(they_are_counted_and_met) {
  FaultSet set;
  FaultSet one;
  for (int number = 1; number < kFaultCount; ++number) {
    set.add(static_cast<Fault>(number));
    assert_int_equal(set.count(), number);
    one = {};
    one.add(static_cast<Fault>(number));
    assert_true(set.has_any(one) && one.has_any(set));
    set.remove(static_cast<Fault>(number));
    assert_false(set.has_any(one));
    set.add(one);
  }
  assert_false(set.has_any({}));
}

TEST(sets_are_united, FaultSet some) {
  some.add(Fault::kBusOff);
  some.add(Fault::kStrokeMissing);
  FaultSet others;
  others.add(Fault::kSensorError);
  others.add(Fault::kBusOff);
  some.add(others);
  some.add(FaultSet{});
  assert_int_equal(some.first(), Fault::kStrokeMissing);
  assert_int_equal(some.after(Fault::kStrokeMissing), Fault::kBusOff);
  assert_int_equal(some.after(Fault::kBusOff), Fault::kSensorError);
  assert_int_equal(some.after(Fault::kSensorError), Fault::kNone);
  // From a fault that is not in it, too.
  assert_int_equal(some.after(Fault::kPressureMissing), Fault::kBusOff);
  assert_false(others.has(Fault::kStrokeMissing));
}
