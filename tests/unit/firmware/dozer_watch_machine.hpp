// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A dozer that does what it is told, for the tests of its watches.

#include <cmath>
#include "firmware/dozer/safety/dozer_watch.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/plain_dozer.hpp"

namespace graben::test::of_dozer {

inline constexpr double kPeriod_s = 0.0625;
inline constexpr double kSlower = 0.25;  // safety.degraded_speed
inline constexpr double kOpen = 0.75;    // Duty; the spool begins to open at 0.25.
inline constexpr int kUnderWay = 50;     // 0.5 s for a displacement to settle, in cycles.
/// Cycles until a spool of 0.1 s would have gone beyond its tolerance: 5 to start, 2 on its way.
inline constexpr int kSpoolUnderWay = 7;

/// A dozer in motion that does what it is told, 1 m/s at half the operator's speed.
struct Machine {
  DozerProfile profile = test::plain_dozer();
  DozerWatchState state;
  DozerLastCommands cycle;
  DozerValid inputs;
  DozerValid seen;

  Machine() {
    cycle.drives.moving = cycle.drives.enable = cycle.drives.active = true;
    inputs.enable = inputs.automatic = inputs.valve_enabled = true;
    inputs.task = Task::kGrade;
    inputs.speed_override_ratio = 0.5;
    inputs.drive[0].stroke_m = 0.5;
    inputs.engine_radps = 40.0;
    drive(0.5, 1.0);
  }
  /// Told and done on both tracks.
  void drive(double pump, double motor) {
    cycle.ratios.pump = inputs.pump_ratio = {pump, pump};
    cycle.ratios.motor = inputs.motor_ratio = {motor, motor};
    inputs.track_speed_mps = {2.0 * pump / motor, 2.0 * pump / motor};
    inputs.velocity_mps = inputs.track_speed_mps[kLeft];
  }
  /// The body and both tracks, whatever the displacements are.
  void run_at(double speed_mps) {
    inputs.track_speed_mps = {speed_mps, speed_mps};
    inputs.velocity_mps = speed_mps;
  }
  const DozerValid& step() {
    const DozerBank bank = dozer_bank(profile);
    inputs.position_m += frozen ? 0.0 : kPeriod_s * inputs.velocity_mps;
    seen = inputs;
    watch(profile, bank.rows(), cycle, kPeriod_s, state, seen);
    return seen;
  }
  const DozerValid& run(int count) {
    repeat(count, [&] { step(); });
    return seen;
  }
  bool frozen = false;  ///< The position is.
  /// Cycles until a fault, counting the one that has it; -1 if none comes.
  int cycles_until(Fault fault) {
    for (int n = 1; n <= 200; ++n) {
      if (step().faults.has(fault)) {
        return n;
      }
    }
    return -1;
  }
};

/// A machine whose operator has let go of it in motion: neutral is sent, nothing has answered yet.
struct Released : Machine {
  Released() {
    cycle.drives.duty_ratio[0] = inputs.drive[0].spool_ratio = kOpen;
    run(kUnderWay);
    const DozerLastCommands nothing;
    cycle = nothing;
    inputs.valve_enabled = false;
    run_at(0.0);
  }
};

inline void assert_well(const DozerValid& inputs) {
  assert_int_equal(inputs.fault, Fault::kNone);
  assert_true(inputs.faults.empty());
  assert_true(inputs.degraded.empty());
  assert_near(inputs.speed_override_ratio, 0.5, 0.0);
}

inline void assert_stopped_by(Fault fault, const DozerValid& inputs) {
  assert_int_equal(inputs.fault, fault);
  assert_true(inputs.faults.has(fault));
  assert_true(inputs.degraded.empty());
}

inline void assert_slowed_by(Fault fault, const DozerValid& inputs) {
  assert_int_equal(inputs.fault, Fault::kNone);
  assert_true(inputs.degraded.has(fault));
  assert_near(inputs.speed_override_ratio, 0.5 * kSlower, 0.0);
}

}  // namespace graben::test::of_dozer
