#pragma once
/// Simulated machine, operator and controller on one bus in memory. They share nothing but frames.

#include <chrono>
#include <cstdint>
#include <optional>
#include <stdexcept>

#include "firmware/core/time.hpp"
#include "firmware/signals/machine_signals.hpp"
#include "platform/loopback/loopback_bus.hpp"

namespace graben::runs {

/// A bench for a kind of machine: its `Node`, its `Operator`, its `Ecu`. The operator gives nothing
/// until kEnable_us, then enables automatic mode, then sets the task.
template <class Node, class Operator, class Ecu>
struct MachineBench {
  using Setup = typename Ecu::Setup;
  static constexpr TimeUs kPeriod_us = 10 * kMillisecondUs;
  static constexpr TimeUs kEnable_us = 200 * kMillisecondUs;
  static constexpr TimeUs kTask_us = 300 * kMillisecondUs;

  /// `node_arguments` are what the node takes before its port and the hash.
  template <class... NodeArguments>
  MachineBench(const Setup& ecu_setup, std::uint32_t hash, Task given_task, double override_ratio,
               const NodeArguments&... node_arguments)
      : setup(ecu_setup),
        profile_hash(hash),
        plant_port(bus.attach()),
        operator_port(bus.attach()),
        ecu_port(bus.attach()),
        task(given_task),
        speed_override_ratio(override_ratio),
        plant(node_arguments..., plant_port, profile_hash),
        driver(operator_port) {
    if (!plant_port.open() || !operator_port.open()) {
      throw std::runtime_error("the bus in memory did not open");
    }
    if (!start_ecu()) {
      throw std::runtime_error("the controller's port did not open");
    }
    enable_from(kEnable_us);
  }
  virtual ~MachineBench() = default;
  MachineBench(const MachineBench&) = delete;
  MachineBench& operator=(const MachineBench&) = delete;

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
    ecu.emplace(setup, profile_hash, ecu_port);
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
  std::uint32_t profile_hash;
  LoopbackBus bus;
  LoopbackPort& plant_port;
  LoopbackPort& operator_port;
  LoopbackPort& ecu_port;
  Task task;
  double speed_override_ratio;
  Node plant;
  Operator driver;
  std::optional<Ecu> ecu;
  /// Time is simulated: a measured cycle time on the bus makes every run's bytes different.
  bool says_cycle_time = false;

 private:
  TimeUs said_cycle_us = 0;
};

}  // namespace graben::runs
