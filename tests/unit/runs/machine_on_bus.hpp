// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A digging machine that has not what ours has, and whose frames a test spoils.

#include <string>

#include "app/runs/dig_run.hpp"
#include "app/runs/excavator_rig.hpp"
#include "app/runs/scenarios.hpp"
#include "tests/unit/cmocka_cpp.hpp"

namespace graben::test {

inline constexpr int kCycle_ms = 10;

/// The 22 t machine as found, arranged so.
inline machines::SimulatedExcavator found(const machines::Scenario& arrangement) {
  runs::DigScenario scenario;
  scenario.errors = "all";
  scenario.scenario = arrangement;
  scenario.scenario.seed = 5;
  return runs::arranged(machines::load_simulated_excavator(machines::find_profile("excavator_22t")),
                        scenario);
}

/// On a shipped bus.
inline machines::SimulatedExcavator on_bus(const std::string& bus) {
  machines::Scenario scenario;
  scenario.bus = bus;
  return found(scenario);
}

struct MachineOnBus {
  explicit MachineOnBus(const std::string& bus) : MachineOnBus(on_bus(bus)) {}
  explicit MachineOnBus(const machines::SimulatedExcavator& given)
      : machine(given), rig(machine, machines::dig_start(machine.profile), 1.0) {}

  void step() {
    rig.step(now);
    now += runs::DigRig::kPeriod_us;
  }
  void dig(TimeUs until = 4 * kSecondUs) {
    while (now < until) {
      step();
    }
    assert_int_equal(status().mode, EcuMode::kActive);
    assert_true(status().stand_in);
    assert_true(rig.plant.spools_enabled());
  }
  [[nodiscard]] const ExcavatorStatus& status() const { return rig.ecu->outputs().status; }
  /// Cycles, in ms, until the machine no longer lets the commands through; the controller runs on
  /// unless it is dead.
  int machine_neutral_after(int most_ms, bool dead = false) {
    int time_ms = 0;
    while (rig.plant.spools_enabled() && time_ms <= most_ms) {
      if (dead) {
        rig.step_machine(now);
        now += runs::DigRig::kPeriod_us;
      } else {
        step();
      }
      time_ms += kCycle_ms;
    }
    print_message("machine neutral after %d ms\n", time_ms);
    assert_false(rig.plant.spools_enabled());
    assert_in_range(time_ms, 0, most_ms);
    return time_ms;
  }
  /// The same of the controller; everything that it commands is neutral then.
  void controller_stops_within(int most_ms) {
    int time_ms = 0;
    while (status().mode == EcuMode::kActive && time_ms <= most_ms) {
      step();
      time_ms += kCycle_ms;
    }
    print_message("fault %d after %d ms\n", static_cast<int>(status().fault), time_ms);
    assert_int_equal(status().mode, EcuMode::kFault);
    assert_in_range(time_ms, 0, most_ms);
    assert_false(rig.ecu->outputs().enable);
    for (const double duty_ratio : rig.ecu->outputs().duty_ratio) {
      assert_near(duty_ratio, 0.0, 0.0);
    }
  }
  /// From now on frames of this id are as `change_data` makes them, or lost where that is false.
  template <class Change>
  void change(std::uint32_t id, const Change& change_data) {
    rig.bus.set_fault_hook([=](CanFrame& frame, const LoopbackPort* from) {
      return from == nullptr || frame.id != id || change_data(frame);
    });
  }

  machines::SimulatedExcavator machine;
  runs::DigRig rig;
  TimeUs now = 0;
};

}  // namespace graben::test
