#include "tests/faults/rig.hpp"

#include <stdexcept>

namespace graben::faults {

Rig::Rig(const machines::ExcavatorMachine& of, const Eigen::Vector3d& start_strokes_m,
         std::size_t ecu_queue)
    : machine(of),
      machine_port(bus.attach()),
      operator_port(bus.attach()),
      ecu_port(bus.attach(ecu_queue)),
      other_port(bus.attach()),
      plant(of.plant, {start_strokes_m[0], start_strokes_m[1], start_strokes_m[2]}, machine_port,
            of.hash),
      driver(operator_port) {
  if (!machine_port.open() || !operator_port.open() || !ecu_port.open() || !other_port.open()) {
    throw std::runtime_error("the bus in memory did not open");
  }
  start_ecu();
  bus.set_fault_hook([this](CanFrame& frame, const LoopbackPort* from) {
    from_ecu_ = from_ecu(from);
    return !tamper || tamper(frame, from);
  });
  // The bus calls it right after the hook, for the same frame.
  bus.set_tap([this](const CanFrame& frame) { record.see(frame, from_ecu_); });
  ask(false, Task::kNone);
}

void Rig::start_ecu() {
  static_cast<void>(ecu_port.open());
  ecu.emplace(machine.profile, machine.hash, ecu_port);
}

void Rig::ask(bool enable, Task task) {
  driver.set_schedule({{0, {enable, OperatorMode::kAutomatic, task, 1.0}}});
}

void Rig::step() {
  bus.set_time(now_us);
  if (before_all) {
    before_all();
  }
  if (closing) {
    closing->before(plant.plant());
  }
  if (machine_on) {
    plant.step(now_us);
  }
  if (closing) {
    closing->after(plant.plant(), !plant.spools_enabled());
  }
  if (plant.spools_enabled()) {
    valve_closed_us = -1;
  } else if (valve_closed_us < 0) {
    valve_closed_us = now_us;
  }
  driver.step(now_us);
  if (before_ecu) {
    before_ecu();
  }
  if (ecu && ecu_on) {
    // Time is simulated: how long the cycle took is not known.
    ecu->step(now_us, 0);
  }
  CanFrame ignored;
  while (other_port.receive(&ignored, 1) == 1) {
  }
  now_us += kCycle_us;
}

void Rig::run(TimeUs duration_us) {
  for (const TimeUs end_us = now_us + duration_us; now_us < end_us;) {
    step();
  }
}

bool Rig::run_until(TimeUs most_us, const std::function<bool()>& done) {
  for (const TimeUs end_us = now_us + most_us; !done() && now_us < end_us;) {
    step();
  }
  return done();
}

}  // namespace graben::faults
