// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The simulated machine, its operator and the controller on a bus in memory, so taken apart that
/// each can be late, stopped, restarted or lied about. They share nothing but frames.

#include <functional>
#include <optional>

#include "firmware/signals/machine_signals.hpp"
#include "platform/loopback/loopback_bus.hpp"
#include "tests/faults/bus_record.hpp"
#include "tests/faults/closing_watch.hpp"

namespace graben::faults {

/// Sees what every controller of a rig has of its bus.
class EcuWitness {
 public:
  /// What a controller that starts now has as its port; lives as long as the witness.
  [[nodiscard]] virtual CanPort& port_of(LoopbackPort& port) = 0;
  /// After a cycle of the controller on that port.
  virtual void note_cycle(const LoopbackPort& port, TimeUs now_us, EcuMode mode) = 0;

 protected:
  ~EcuWitness() = default;
};

template <class Kind>
class Rig {
 public:
  using Outputs = typename Kind::Ecu::Outputs;

  /// `witness` sees its controllers; null: nobody does.
  Rig(const typename Kind::Scenery& scenery, std::size_t ecu_queue, EcuWitness* witness = nullptr);

  /// A cycle of everybody who is on: machine, operator, then the controller.
  void step();
  void run(TimeUs duration_us);
  /// Steps until `done` holds; false if that takes longer than `most_us`.
  bool run_until(TimeUs most_us, const std::function<bool()>& done);

  /// What the operator asks for from the next cycle on, in automatic mode, at that share of full
  /// speed.
  void ask(bool enable, Task task, double speed_ratio = 1.0);
  /// The controller's process ends, or starts anew.
  void kill_ecu() { ecu.reset(); }
  void start_ecu();

  /// Of the cycle that was stepped last.
  [[nodiscard]] TimeUs at_us() const { return now_us - kCycle_us; }
  [[nodiscard]] bool from_ecu(const LoopbackPort* from) const { return from == &ecu_port; }
  [[nodiscard]] const Outputs& outputs() const { return ecu->outputs(); }
  /// Whether the machine's side lets the commands through.
  [[nodiscard]] bool enabled() const { return Kind::enabled(plant); }
  [[nodiscard]] EcuMode mode() const { return ecu ? outputs().status.mode : EcuMode::kSilent; }

  const typename Kind::Machine& machine;
  LoopbackBus bus;
  LoopbackPort& machine_port;
  LoopbackPort& operator_port;
  LoopbackPort& ecu_port;
  LoopbackPort& other_port;  ///< Of a node that should not be there.
  typename Kind::Node plant;
  typename Kind::Operator driver;
  std::optional<typename Kind::Ecu> ecu;
  BusRecord record;
  std::optional<ClosingWatch<Kind>> closing;
  TimeUs now_us = 0;           ///< Of the next cycle.
  TimeUs valve_closed_us = 0;  ///< When the valve side went neutral last; -1 while it is enabled.

  bool machine_on = true;
  bool ecu_on = true;  ///< Off: it is there and its cycle is not called.
  /// May alter a frame on its way; false loses it. Empty: nothing is done to any.
  LoopbackBus::FaultHook tamper;
  /// Called in each cycle before anybody's step, and before the controller's. Both may send.
  std::function<void()> before_all;
  std::function<void()> before_ecu;

 private:
  EcuWitness* witness_;
  bool from_ecu_ = false;
};

}  // namespace graben::faults
