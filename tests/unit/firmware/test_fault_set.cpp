// SPDX-License-Identifier: Apache-2.0
#include "firmware/core/fault_set.hpp"

#include "tests/unit/cmocka_cpp.hpp"

namespace {

using namespace graben;

void it_begins_empty(void**) {
  const FaultSet none;
  assert_true(none.empty());
  assert_int_equal(none.bits(), 0);
  assert_int_equal(none.first(), Fault::kNone);
  for (int code = 0; code < kFaultCount; ++code) {
    assert_false(none.has(static_cast<Fault>(code)));
  }
}

/// Bit n is the fault of number n, which is what goes on the bus.
void each_fault_has_its_own_bit(void**) {
  for (int code = 1; code < kFaultCount; ++code) {
    FaultSet one;
    one.add(static_cast<Fault>(code));
    assert_false(one.empty());
    assert_true(one.bits() == std::uint64_t{1} << static_cast<unsigned>(code));
    assert_int_equal(one.first(), code);
    assert_int_equal(one.after(static_cast<Fault>(code)), Fault::kNone);
    for (int other = 0; other < kFaultCount; ++other) {
      assert_int_equal(one.has(static_cast<Fault>(other)), other == code);
    }
  }
}

void none_is_never_in_it(void**) {
  FaultSet faults;
  faults.add(Fault::kNone);
  assert_true(faults.empty());
  assert_false(faults.has(Fault::kNone));
}

/// A number beyond the last fault's may be in it, from a newer sender; nobody is told of it.
void an_unknown_number_is_not_named(void**) {
  FaultSet faults;
  faults.add(static_cast<Fault>(kFaultCount));
  assert_int_equal(faults.first(), Fault::kNone);
  assert_int_equal(faults.after(Fault::kSensorError), Fault::kNone);
}

void sets_are_united(void**) {
  FaultSet some;
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

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(it_begins_empty),     cmocka_unit_test(each_fault_has_its_own_bit),
      cmocka_unit_test(none_is_never_in_it), cmocka_unit_test(an_unknown_number_is_not_named),
      cmocka_unit_test(sets_are_united),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
