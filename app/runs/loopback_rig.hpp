// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Simulated machine, operator and controller on one bus in memory. They share nothing but frames.

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>
#include <stdexcept>

#include "firmware/core/time.hpp"
#include "firmware/machine/unknown_drives.hpp"
#include "firmware/signals/machine_signals.hpp"
#include "hal/buses/bus_table.hpp"
#include "platform/loopback/loopback_bus.hpp"

namespace graben::runs {

/// Of its full speed that a task is done with; what is refused counts as slow. For how long it may
/// take.
[[nodiscard]] inline double speed_ratio(const UnknownDrives& unknown, Task task,
                                        double override_ratio) {
  constexpr double kLeast = 0.05;
  return override_ratio * std::max(kLeast, unknown.left_ratio(task, 0));
}

/// The nodes of one run. The operator gives nothing until kEnable_us, then enables automatic mode,
/// then sets the task.
///
/// `Kind` is a machine kind (app/ecu/ecu_node.hpp) that can be simulated: Machine, what its files
/// say, with `hash`; Node, the machine on its bus, with step(now_us); Operator, as
/// plant::OperatorNode; Start, where a machine begins; node(machine, start, port), which makes it;
/// table(machine), of another bus than ours, empty where there is none.
template <class Kind>
struct LoopbackRig {
  using Machine = typename Kind::Machine;
  using Setup = typename Kind::Setup;
  using Start = typename Kind::Start;
  static constexpr TimeUs kPeriod_us = 10 * kMillisecondUs;
  static constexpr TimeUs kEnable_us = 200 * kMillisecondUs;
  static constexpr TimeUs kTask_us = 300 * kMillisecondUs;

  LoopbackRig(const Machine& machine, const Setup& ecu_setup, const Start& start, Task given_task,
              double override_ratio)
      : setup(ecu_setup),
        bus_table(Kind::table(machine)),
        profile_hash(machine.hash),
        plant_port(bus.attach()),
        operator_port(bus.attach()),
        ecu_port(bus.attach()),
        task(given_task),
        speed_override_ratio(override_ratio),
        plant(Kind::node(machine, start, plant_port)),
        driver(operator_port) {
    if (!plant_port.open() || !operator_port.open()) {
      throw std::runtime_error("the bus in memory did not open");
    }
    if (!start_ecu()) {
      throw std::runtime_error("the controller's port did not open");
    }
    enable_from(kEnable_us);
  }
  virtual ~LoopbackRig() = default;
  LoopbackRig(const LoopbackRig&) = delete;
  LoopbackRig& operator=(const LoopbackRig&) = delete;

  /// Everyone's cycle at `now_us`, machine first; returns how long the controller computed, in
  /// microseconds of real time.
  double step(TimeUs now_us) {
    step_machine(now_us);
    return step_ecu(now_us);
  }

  /// The machine's cycle and the operator's; the controller's comes after it.
  void step_machine(TimeUs now_us) {
    bus.set_time(now_us);
    plant.step(now_us);
    driver.step(now_us);
  }
  /// As step(); the controller must be there.
  double step_ecu(TimeUs now_us) {
    const auto begin = std::chrono::steady_clock::now();
    ecu->step(now_us, said_cycle_us);
    const double cycle_us =
        std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count();
    said_cycle_us = says_cycle_time ? static_cast<TimeUs>(cycle_us) : 0;
    return cycle_us;
  }

  /// The controller's process begins, neutral and knowing nothing; it ends by ecu.reset().
  /// False: its bus is down, and it opens that itself once it can.
  bool start_ecu() {
    const bool is_open = ecu_port.open();
    ecu.emplace(setup, profile_hash, ecu_port, &bus_table);
    return is_open;
  }

  /// The operator lets go of the deadman, for good.
  void release() {
    driver.set_schedule({{0, {false, OperatorMode::kAutomatic, Task::kNone, 0.0}}});
  }

  /// The operator, having let go, enables at `enable_us` and sets the task 100 ms later.
  void enable_from(TimeUs enable_us) {
    driver.set_schedule({{0, {false, OperatorMode::kAutomatic, Task::kNone, 0.0}},
                         {enable_us, {true, OperatorMode::kAutomatic, Task::kNone, 0.0}},
                         {enable_us + kTask_us - kEnable_us,
                          {true, OperatorMode::kAutomatic, task, speed_override_ratio}}});
  }

  Setup setup;
  BusTable bus_table;  ///< Of another bus than ours; empty: none.
  std::uint32_t profile_hash;
  LoopbackBus bus;
  LoopbackPort& plant_port;
  LoopbackPort& operator_port;
  LoopbackPort& ecu_port;
  Task task;
  double speed_override_ratio;
  typename Kind::Node plant;
  typename Kind::Operator driver;
  std::optional<typename Kind::Ecu> ecu;
  /// Time is simulated: a measured cycle time on the bus makes every run's bytes different.
  bool says_cycle_time = false;

 private:
  TimeUs said_cycle_us = 0;
};

}  // namespace graben::runs
