#include <limits>

#include "firmware/safety/validation.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/fixture.hpp"
#include "tests/unit/firmware/inputs.hpp"

namespace {

using namespace graben;
using test::complete_inputs;

constexpr TimeUs kNow = 5 * kSecondUs;

const ExcavatorProfile& profile() { return test::excavator().profile; }

Fault fault_of(const ExcavatorInputs& inputs) {
  return validate(inputs, profile(), {}, false, kNow).fault;
}

void complete_inputs_become_a_state(void**) {
  const ValidInputs valid = validate(complete_inputs(kNow), profile(), {}, false, kNow);
  assert_int_equal(valid.fault, Fault::kNone);
  assert_true(valid.enable && valid.automatic);
  assert_int_equal(valid.task, Task::kDig);
  assert_near(valid.strokes_m[kArm], 1.1, 0.0);
  // 119 cm3/rev at 188.5 rad/s and 64.3 % swash: 137.7 L/min.
  const auto flow_m3ps = pump_flow_m3ps(profile(), valid.engine_radps, valid.swash_ratio);
  assert_near(flow_m3ps[0] * 60e3, 137.7, 0.1);
}

/// Every required signal, each in every state that is not usable, gives its own fault.
void each_signal_is_required(void**) {
  struct Row {
    Signal<double>* (*signal)(ExcavatorInputs&);
    Fault fault;
  };
  const Row rows[] = {
      {[](ExcavatorInputs& in) { return &in.axis[0].stroke_m; }, Fault::kStrokeMissing},
      {[](ExcavatorInputs& in) { return &in.axis[1].stroke_m; }, Fault::kStrokeMissing},
      {[](ExcavatorInputs& in) { return &in.axis[2].stroke_m; }, Fault::kStrokeMissing},
      {[](ExcavatorInputs& in) { return &in.axis[0].cap_pressure_pa; }, Fault::kPressureMissing},
      {[](ExcavatorInputs& in) { return &in.axis[1].cap_pressure_pa; }, Fault::kPressureMissing},
      {[](ExcavatorInputs& in) { return &in.axis[2].cap_pressure_pa; }, Fault::kPressureMissing},
      {[](ExcavatorInputs& in) { return &in.axis[0].rod_pressure_pa; }, Fault::kPressureMissing},
      {[](ExcavatorInputs& in) { return &in.axis[1].rod_pressure_pa; }, Fault::kPressureMissing},
      {[](ExcavatorInputs& in) { return &in.axis[2].rod_pressure_pa; }, Fault::kPressureMissing},
      {[](ExcavatorInputs& in) { return &in.swash_ratio[0]; }, Fault::kSwashMissing},
      {[](ExcavatorInputs& in) { return &in.swash_ratio[1]; }, Fault::kSwashMissing},
      {[](ExcavatorInputs& in) { return &in.engine_speed_radps; }, Fault::kEngineSpeedMissing},
      {[](ExcavatorInputs& in) { return &in.driver.speed_override_ratio; },
       Fault::kOperatorMissing},
  };
  for (const Row& row : rows) {
    for (const Validity validity : {Validity::kNotReceived, Validity::kNotAvailable,
                                    Validity::kError, Validity::kOutOfRange}) {
      ExcavatorInputs inputs = complete_inputs(kNow);
      row.signal(inputs)->validity = validity;
      assert_int_equal(fault_of(inputs), row.fault);
    }
    ExcavatorInputs old = complete_inputs(kNow);
    row.signal(old)->stamp_us = kNow - 50 * kMillisecondUs;
    assert_int_equal(fault_of(old), row.fault);
    row.signal(old)->stamp_us = kNow - 40 * kMillisecondUs;
    assert_int_equal(fault_of(old), Fault::kNone);
    for (const TimeUs wrong :
         {kNow + 1, std::numeric_limits<TimeUs>::min(), std::numeric_limits<TimeUs>::max()}) {
      row.signal(old)->stamp_us = wrong;
      assert_int_equal(fault_of(old), row.fault);
    }
  }
}

void a_value_that_is_no_number_is_missing(void**) {
  ExcavatorInputs inputs = complete_inputs(kNow);
  inputs.axis[0].stroke_m.value = std::numeric_limits<double>::quiet_NaN();
  assert_int_equal(fault_of(inputs), Fault::kStrokeMissing);
  inputs = complete_inputs(kNow);
  inputs.driver.speed_override_ratio.value = std::numeric_limits<double>::quiet_NaN();
  assert_int_equal(fault_of(inputs), Fault::kOperatorMissing);
}

void enable_must_be_fresh(void**) {
  ExcavatorInputs inputs = complete_inputs(kNow);
  inputs.driver.enable.stamp_us = kNow - 60 * kMillisecondUs;
  const ValidInputs stale = validate(inputs, profile(), {}, false, kNow);
  assert_false(stale.enable);
  assert_int_equal(stale.fault, Fault::kOperatorMissing);
}

/// A machine with another profile, one that does not say, and one that fell silent.
void another_machine_is_refused(void**) {
  ExcavatorInputs inputs = complete_inputs(kNow);
  inputs.same_machine.value = false;
  assert_int_equal(fault_of(inputs), Fault::kIdentityMismatch);
  inputs.same_machine = {};
  assert_int_equal(fault_of(inputs), Fault::kIdentityMismatch);
  inputs.same_machine = test::fresh(true, kNow - 2 * kSecondUs);
  assert_int_equal(fault_of(inputs), Fault::kNone);
  inputs.same_machine = test::fresh(true, kNow - 3 * kSecondUs);
  assert_int_equal(fault_of(inputs), Fault::kIdentityMismatch);
}

void strokes_outside_their_cylinder_are_implausible(void**) {
  const double most = profile().geometry.cylinder[kBucket].stroke_m;
  ExcavatorInputs inputs = complete_inputs(kNow);
  inputs.axis[kBucket].stroke_m.value = most + 0.002;  // A worn encoder at the stroke's end.
  const ValidInputs biased = validate(inputs, profile(), {}, false, kNow);
  assert_int_equal(biased.fault, Fault::kNone);
  assert_near(biased.strokes_m[kBucket], most, 0.0);
  inputs.axis[kBucket].stroke_m.value = most + 0.011;
  assert_int_equal(fault_of(inputs), Fault::kStrokeImplausible);
  inputs.axis[kBucket].stroke_m.value = -0.011;
  assert_int_equal(fault_of(inputs), Fault::kStrokeImplausible);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(complete_inputs_become_a_state),
      cmocka_unit_test(each_signal_is_required),
      cmocka_unit_test(a_value_that_is_no_number_is_missing),
      cmocka_unit_test(enable_must_be_fresh),
      cmocka_unit_test(another_machine_is_refused),
      cmocka_unit_test(strokes_outside_their_cylinder_are_implausible),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
