#pragma once
/// The shipped excavators for tests of the core.

#include "app/machines/excavator_file.hpp"

namespace graben::test {

/// Read once; a profile that can't be loaded ends the test program with its errors.
inline const machines::ExcavatorMachine& excavator() {
  static const machines::ExcavatorMachine machine =
      machines::load_excavator(machines::find_profile("excavator_22t"));
  return machine;
}

inline const machines::ExcavatorMachine& excavator_12t() {
  static const machines::ExcavatorMachine machine =
      machines::load_excavator(machines::find_profile("excavator_12t"));
  return machine;
}

}  // namespace graben::test
