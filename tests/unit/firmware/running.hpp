// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A controller brought to kActive the way an operator does it, and what it must be after a fault.

#include <memory>

#include "firmware/excavator/excavator_controller.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/fixture.hpp"
#include "tests/unit/firmware/inputs.hpp"

namespace graben::test {

struct Running {
  static constexpr TimeUs kPeriod = 10 * kMillisecondUs;
  /// Makes inputs of the shipped 22 t machine those of another.
  using Adapt = void (*)(ExcavatorInputs&);

  std::shared_ptr<const ExcavatorSetup> setup;  ///< Of its copies too.
  ExcavatorController controller;
  Adapt adapt;
  TimeUs now_us = kSecondUs;
  ExcavatorOutputs outputs;

  ExcavatorOutputs step(const ExcavatorInputs& inputs) {
    outputs = controller.step(inputs, now_us);
    now_us += kPeriod;
    return outputs;
  }
  [[nodiscard]] ExcavatorInputs inputs() const {
    ExcavatorInputs inputs = following_inputs(outputs, now_us);
    adapt(inputs);
    return inputs;
  }

  [[nodiscard]] ExcavatorInputs at_rest(bool enable) const {
    ExcavatorInputs resting = inputs();
    resting.driver.enable.value = enable;
    resting.driver.task.value = Task::kNone;
    return resting;
  }

  explicit Running(
      const ExcavatorProfile& machine = excavator().profile,
      Adapt as_it_is = [](ExcavatorInputs&) {})
      : setup(std::make_shared<ExcavatorSetup>(machine)), controller(*setup), adapt(as_it_is) {
    ExcavatorInputs released = inputs();
    released.driver.enable.value = false;
    step(released);

    step(at_rest(false));
    step(at_rest(true));
    step(inputs());
  }
};

inline void assert_neutral(const ExcavatorOutputs& outputs) {
  assert_false(outputs.enable);
  for (const double duty : outputs.duty_ratio) {
    assert_near(duty, 0.0, 0.0);
  }
}

}  // namespace graben::test
