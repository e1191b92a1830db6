#pragma once
/// Simulated machine, operator and controller on one bus in memory. They share nothing but frames.

#include <chrono>
#include <cstdint>
#include <stdexcept>

#include "firmware/core/time.hpp"
#include "firmware/signals/machine_signals.hpp"
#include "platform/loopback/loopback_bus.hpp"

namespace graben::cli {

/// A bench for a kind of machine: its `Node`, its `Operator`, its `Ecu`. The operator gives nothing
/// until kEnable_us, then enables automatic mode, then sets the task.
template <class Node, class Operator, class Ecu>
struct MachineBench {
  static constexpr TimeUs kPeriod_us = 10 * kMillisecondUs;
  static constexpr TimeUs kEnable_us = 200 * kMillisecondUs;
  static constexpr TimeUs kTask_us = 300 * kMillisecondUs;

  /// `node_arguments` are what the node takes before its port and the hash.
  template <class Profile, class... NodeArguments>
  MachineBench(const Profile& profile, std::uint32_t profile_hash, Task given_task,
               double override_ratio, const NodeArguments&... node_arguments)
      : plant_port(bus.attach()),
        operator_port(bus.attach()),
        ecu_port(bus.attach()),
        task(given_task),
        speed_override_ratio(override_ratio),
        plant(node_arguments..., plant_port, profile_hash),
        driver(operator_port),
        ecu(profile, profile_hash, ecu_port) {
    if (!plant_port.open() || !operator_port.open() || !ecu_port.open()) {
      throw std::runtime_error("the bus in memory did not open");
    }
    enable_from(kEnable_us);
  }

  /// Everyone's cycle at `now_us`, machine first; returns how long the controller computed, in
  /// microseconds of real time.
  double step(TimeUs now_us) {
    bus.set_time(now_us);
    plant.step(now_us);
    driver.step(now_us);
    const auto begin = std::chrono::steady_clock::now();
    // Time is simulated: a measured cycle time on the bus would make every run's bytes different.
    ecu.step(now_us, 0);
    return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin)
        .count();
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

  LoopbackBus bus;
  LoopbackPort& plant_port;
  LoopbackPort& operator_port;
  LoopbackPort& ecu_port;
  Task task;
  double speed_override_ratio;
  Node plant;
  Operator driver;
  Ecu ecu;
};

}  // namespace graben::cli
