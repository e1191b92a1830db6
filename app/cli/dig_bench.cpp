#include "app/cli/dig_bench.hpp"

#include <chrono>
#include <stdexcept>

namespace graben::cli {

DigBench::DigBench(const machines::ExcavatorMachine& machine,
                   const Eigen::Vector3d& start_strokes_m, double override_ratio)
    : plant_port(bus.attach()),
      operator_port(bus.attach()),
      ecu_port(bus.attach()),
      speed_override_ratio(override_ratio),
      plant(machine.plant, {start_strokes_m[0], start_strokes_m[1], start_strokes_m[2]}, plant_port,
            machine.hash),
      driver(operator_port),
      ecu(machine.profile, machine.hash, ecu_port) {
  if (!plant_port.open() || !operator_port.open() || !ecu_port.open()) {
    throw std::runtime_error("the bus in memory did not open");
  }
  enable_from(kEnable_us);
}

double DigBench::step(TimeUs now_us) {
  bus.set_time(now_us);
  plant.step(now_us);
  driver.step(now_us);
  const auto begin = std::chrono::steady_clock::now();
  // Time is simulated: a measured cycle time on the bus would make every run's bytes different.
  ecu.step(now_us, 0);
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin)
      .count();
}

void DigBench::enable_from(TimeUs enable_us) {
  driver.set_schedule({{0, {false, OperatorMode::kAutomatic, Task::kNone, 0.0}},
                       {enable_us, {true, OperatorMode::kAutomatic, Task::kNone, 0.0}},
                       {enable_us + kTask_us - kEnable_us,
                        {true, OperatorMode::kAutomatic, Task::kDig, speed_override_ratio}}});
}

void DigBench::release() {
  driver.set_schedule({{0, {false, OperatorMode::kAutomatic, Task::kNone, 0.0}}});
}

}  // namespace graben::cli
