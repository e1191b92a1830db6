// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The controllers' friends: what they keep from cycle to cycle. What is written here is sealed
/// only where a test says so.

#include "firmware/dozer/dozer_controller.hpp"
#include "firmware/excavator/excavator_controller.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/flip_bit.hpp"

namespace graben {

struct ControllerMemoryAccess {
  /// Of a node on a bus.
  template <class Ecu>
  static auto& controller(Ecu& ecu) {
    return ecu.controller_;
  }
  static auto& memory(ExcavatorController& controller) { return controller.memory_; }
  static auto& last(ExcavatorController& controller) { return controller.memory_->last.commands; }
};

struct DozerMemoryAccess {
  static auto& memory(DozerController& controller) { return controller.memory_; }
};

namespace test {

/// Any bit that flips between two cycles in what is kept, whatever it is of: found.
template <class Kept>
void assert_every_bit_is_sealed(Sealed<Kept>& memory) {
  for (std::size_t bit = 0; bit < 8 * sizeof memory; ++bit) {
    flip_bit_at(&memory, bit);
    assert_false(memory.intact());
    flip_bit_at(&memory, bit);
  }
  assert_true(memory.intact());
}

}  // namespace test
}  // namespace graben
