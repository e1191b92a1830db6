// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The shipped excavators for tests of the core.

#include "app/machines/simulated/simulated_excavator.hpp"

namespace graben::test {

/// Read once; a profile that can't be loaded ends the test program with its errors.
inline const machines::SimulatedExcavator& excavator() {
  static const machines::SimulatedExcavator machine =
      machines::load_simulated_excavator(machines::find_profile("excavator_22t"));
  return machine;
}

inline const machines::SimulatedExcavator& excavator_12t() {
  static const machines::SimulatedExcavator machine =
      machines::load_simulated_excavator(machines::find_profile("excavator_12t"));
  return machine;
}

}  // namespace graben::test
