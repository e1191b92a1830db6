// SPDX-License-Identifier: Apache-2.0
// A controller whose cycle comes late once, as on a computer that was held up: how far the tip is
// off its path because of it, at 0.3 m/s.

#include <algorithm>

#include "tests/unit/runs/machine_on_bus.hpp"

constexpr TimeUs kCycle_us = runs::DigRig::kPeriod_us;
constexpr TimeUs kLooks_us = 1500 * kMillisecondUs;
/// From one place on the path to the next.
constexpr TimeUs kApart_us = 590 * kMillisecondUs;

struct Looked {
  double most_m = 0.0;  ///< Of the true tip from the path.
  Fault fault = Fault::kNone;
};

/// From `at_us` on; the next cycle of the controller comes `late_us` after the one there.
Looked look(const machines::SimulatedExcavator& machine, double override_ratio, TimeUs at_us,
            TimeUs late_us) {
  runs::DigRig rig(machine, machines::dig_start(machine.profile), override_ratio);
  const RoundedRectangle path(machine.profile.dig_path);
  Looked looked;
  for (TimeUs now_us = kCycle_us; now_us < at_us + kLooks_us; now_us += kCycle_us) {
    rig.step_machine(now_us);
    if (now_us <= at_us || now_us >= at_us + late_us) {
      rig.step_ecu(now_us);
    }
    if (now_us >= at_us) {
      const Eigen::Vector2d tip_m = rig.plant.plant().tip().position_m;
      looked.most_m = std::max(looked.most_m, (path.closest(tip_m).position_m - tip_m).norm());
    }
  }
  looked.fault = rig.ecu->outputs().status.fault;
  return looked;
}

struct Case {
  const char* machine;
  double override_ratio;  ///< Of the profile's speed, to make 0.3 m/s.
};

constexpr Case kCases[] = {{"excavator_22t", 0.5}, {"excavator_12t", 0.6}};

/// More than in time: up to 3 mm, but where a spool that starts is led through its lag just then.
/// Its duty, meant for 10 ms, then stands five times as long; the lead's bound keeps that small
/// (unbounded, of 632 places 70 ms apart the worst two were 28 and 23 mm).
TEST(a_late_cycle_costs_little) {
  constexpr double kMost_m = 0.003;
  constexpr double kMostLed_m = 0.006;
  for (const Case& each : kCases) {
    const machines::SimulatedExcavator machine =
        machines::load_simulated_excavator(machines::find_profile(each.machine));
    int places = 0;
    int beyond = 0;
    double worst_m = 0.0;
    for (TimeUs at_us = 5 * kSecondUs; at_us < 16 * kSecondUs; at_us += kApart_us) {
      const double in_time_m = look(machine, each.override_ratio, at_us, kCycle_us).most_m;
      for (const TimeUs late_us : {30 * kMillisecondUs, 50 * kMillisecondUs}) {
        const Looked late = look(machine, each.override_ratio, at_us, late_us);
        assert_int_equal(late.fault, Fault::kNone);
        const double more_m = late.most_m - in_time_m;
        places += 1;
        beyond += more_m > kMost_m ? 1 : 0;
        worst_m = std::max(worst_m, more_m);
      }
    }
    print_message("%s: %.1f mm more at most, %d of %d over 3 mm\n", each.machine, 1e3 * worst_m,
                  beyond, places);
    assert_true(worst_m <= kMostLed_m);
    assert_true(16 * beyond <= places);
  }
}

TEST(a_stall_stops) {
  const machines::SimulatedExcavator machine =
      machines::load_simulated_excavator(machines::find_profile("excavator_22t"));
  assert_int_equal(look(machine, 0.5, 8 * kSecondUs, 60 * kMillisecondUs).fault,
                   Fault::kCycleStalled);
}
