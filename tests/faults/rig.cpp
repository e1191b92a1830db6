// SPDX-License-Identifier: Apache-2.0
#include "tests/faults/rig.hpp"

#include <stdexcept>

#include "tests/faults/dozer_kind.hpp"
#include "tests/faults/excavator_kind.hpp"

namespace graben::faults {

template <class Kind>
Rig<Kind>::Rig(const typename Kind::Scenery& scenery, std::size_t ecu_queue, EcuWitness* witness)
    : machine(scenery.machine),
      machine_port(bus.attach()),
      operator_port(bus.attach()),
      ecu_port(bus.attach(ecu_queue)),
      other_port(bus.attach()),
      plant(Kind::node(scenery, machine_port)),
      driver(operator_port),
      witness_(witness) {
  if (!machine_port.open() || !operator_port.open() || !ecu_port.open() || !other_port.open()) {
    throw std::runtime_error("the bus in memory did not open");
  }
  start_ecu();
  bus.set_fault_hook([this](CanFrame& frame, const LoopbackPort* from) {
    from_ecu_ = from_ecu(from);
    return !tamper || tamper(frame, from);
  });
  // The bus calls it right after the hook, for the same frame.
  bus.set_tap([this](const CanFrame& frame) { record.template see<Kind>(frame, from_ecu_); });
  ask(false, Task::kNone);
}

template <class Kind>
void Rig<Kind>::start_ecu() {
  static_cast<void>(ecu_port.open());
  CanPort& port = witness_ != nullptr ? witness_->port_of(ecu_port) : ecu_port;
  ecu.emplace(Kind::setup_of(machine), machine.hash, port, Kind::table(machine));
}

template <class Kind>
void Rig<Kind>::ask(bool enable, Task task, double speed_ratio) {
  driver.set_schedule({{0, {enable, OperatorMode::kAutomatic, task, speed_ratio}}});
}

template <class Kind>
void Rig<Kind>::step() {
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
    closing->after(plant.plant(), !enabled());
  }
  if (enabled()) {
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
    if (witness_ != nullptr) {
      witness_->note_cycle(ecu_port, now_us, mode());
    }
  }
  CanFrame ignored;
  while (other_port.receive(&ignored, 1) == 1) {
  }
  now_us += kCycle_us;
}

template <class Kind>
void Rig<Kind>::run(TimeUs duration_us) {
  for (const TimeUs end_us = now_us + duration_us; now_us < end_us;) {
    step();
  }
}

template <class Kind>
bool Rig<Kind>::run_until(TimeUs most_us, const std::function<bool()>& done) {
  for (const TimeUs end_us = now_us + most_us; !done() && now_us < end_us;) {
    step();
  }
  return done();
}

template class Rig<Excavator>;
template class Rig<Dozer>;

}  // namespace graben::faults
