// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Complete, fresh inputs for tests of the core.

#include "firmware/excavator/excavator_signals.hpp"

namespace graben::test {

template <class T>
Signal<T> fresh(T value, TimeUs stamp_us) {
  return {value, Validity::kValid, stamp_us};
}

/// A machine at rest near the path, enabled for the task, everything stamped now.
inline ExcavatorInputs complete_inputs(TimeUs now_us) {
  ExcavatorInputs inputs;
  const double strokes_m[] = {1.05, 1.1, 0.4};
  for (unsigned i = 0; i < kAxisCount; ++i) {
    inputs.axis[i].stroke_m = fresh(strokes_m[i], now_us);
    inputs.axis[i].cap_pressure_pa = fresh(4e6, now_us);
    inputs.axis[i].rod_pressure_pa = fresh(3e6, now_us);
    inputs.axis[i].spool_ratio = fresh(0.0, now_us);
  }
  inputs.swing = {fresh(0.0, now_us), fresh(4e6, now_us), fresh(3e6, now_us), fresh(0.0, now_us)};
  for (Signal<double>& swash : inputs.swash_ratio) {
    swash = fresh(0.643, now_us);
  }
  inputs.engine_speed_radps = fresh(188.5, now_us);
  inputs.driver.enable = fresh(true, now_us);
  inputs.driver.mode = fresh(OperatorMode::kAutomatic, now_us);
  inputs.driver.task = fresh(Task::kDig, now_us);
  inputs.driver.speed_override_ratio = fresh(1.0, now_us);
  inputs.valve_enabled = fresh(false, now_us);
  inputs.same_machine = fresh(true, now_us);
  inputs.link.bus = BusState::kActive;
  return inputs;
}

/// The same machine's inputs as the 12 t machine's: within its strokes, its pump at its speed.
inline void make_12t(ExcavatorInputs& inputs) {
  const double strokes_m[] = {0.475, 0.565, 0.4375};
  for (unsigned i = 0; i < kAxisCount; ++i) {
    inputs.axis[i].stroke_m.value = strokes_m[i];
  }
  inputs.engine_speed_radps.value = 151.8;
}

/// The same from valve and pumps that have done what they were told.
inline ExcavatorInputs following_inputs(const ExcavatorOutputs& told, TimeUs now_us) {
  ExcavatorInputs inputs = complete_inputs(now_us);
  inputs.valve_enabled.value = told.enable;
  for (unsigned j = 0; j < kPumpCount; ++j) {
    inputs.swash_ratio[j].value = told.enable ? told.swash_ratio[j] : inputs.swash_ratio[j].value;
  }
  for (unsigned i = 0; i < kAxisCount; ++i) {
    inputs.axis[i].spool_ratio.value = told.duty_ratio[i];
  }
  inputs.swing.spool_ratio.value = told.duty_ratio[3];
  return inputs;
}

}  // namespace graben::test
