// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A machine in motion, for what watches it.

#include "firmware/excavator/safety/excavator_validation.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/plain_machine.hpp"

namespace graben::test {

inline constexpr double kPeriod_s = 0.0625;
inline constexpr double kSlower = 0.25;  // safety.degraded_speed

inline void set_spools(ExcavatorValid& inputs, const std::array<double, kAxisCount>& spool_ratio) {
  for (unsigned i = 0; i < kAxisCount; ++i) {
    inputs.drive[i].spool_ratio = spool_ratio[i];
  }
}
inline void set_strokes(ExcavatorValid& inputs, const std::array<double, kDriveCount>& stroke_m) {
  for (unsigned i = 0; i < kDriveCount; ++i) {
    inputs.drive[i].stroke_m = stroke_m[i];
  }
}

/// A machine in motion that does what it is told, at half the operator's speed.
struct Machine {
  ExcavatorProfile profile = plain_machine();
  ExcavatorBank bank = excavator_bank(profile);
  ExcavatorWatchState state;
  LastCommands<kDriveCount> cycle;
  ExcavatorValid inputs;
  ExcavatorValid seen;
  int cycles = 0;

  Machine() {
    cycle.moving = true;
    cycle.active = true;
    cycle.enable = true;
    inputs.enable = inputs.automatic = inputs.valve_enabled = true;
    inputs.task = Task::kDig;
    inputs.speed_override_ratio = 0.5;
    for (unsigned i = 0; i < kAxisCount; ++i) {
      inputs.drive[i].stroke_m = 0.5;
      inputs.drive[i].load_known = true;
    }
    inputs.swash_ratio = profile.dig_swash_ratio;
    inputs.engine_radps = 200.0;
  }
  const ExcavatorValid& step(double period_s = kPeriod_s) {
    ++cycles;
    if (!frozen) {
      for (unsigned i = 0; i < kAxisCount; ++i) {
        inputs.drive[i].cap_pressure_pa = 4e6 + cycles;
        inputs.drive[i].rod_pressure_pa = 3e6 + cycles;
      }
    }
    seen = inputs;
    watch(profile, bank.rows(), cycle, profile.dig_swash_ratio, period_s, state, seen);
    return seen;
  }
  void run(int count) {
    repeat(count, [&] { step(); });
  }
  bool frozen = false;
};

inline void assert_well(const ExcavatorValid& inputs) {
  assert_int_equal(inputs.fault, Fault::kNone);
  assert_true(inputs.faults.empty());
  assert_true(inputs.degraded.empty());
  assert_near(inputs.speed_override_ratio, 0.5, 0.0);
  for (unsigned i = 0; i < kAxisCount; ++i) {
    assert_true(inputs.drive[i].load_known);
  }
}

inline void assert_stopped_by(Fault fault, const ExcavatorValid& inputs) {
  assert_int_equal(inputs.fault, fault);
  assert_true(inputs.faults.has(fault));
  assert_true(inputs.degraded.empty());
}

inline void assert_slowed_by(Fault fault, const ExcavatorValid& inputs) {
  assert_int_equal(inputs.fault, Fault::kNone);
  assert_true(inputs.degraded.has(fault));
  assert_near(inputs.speed_override_ratio, 0.5 * kSlower, 0.0);
}

}  // namespace graben::test
