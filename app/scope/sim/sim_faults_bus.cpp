// SPDX-License-Identifier: Apache-2.0
// The bus itself.

#include "app/scope/sim/sim_faults.hpp"

namespace graben::scope {
namespace {

/// All that 500 kbit/s can carry in a cycle, of the highest priority.
template <class Kind>
SimEffect babble(SimRig<Kind>& rig) {
  constexpr int kFramesPerCycle = 38;
  SimEffect effect = switched<Kind>(rig, [](typename Kind::Rig& nodes, bool on) {
    nodes.bus.set_babble(on ? std::optional<std::uint32_t>(0) : std::nullopt);
  });
  effect.before_controller = [&rig] {
    CanFrame frame;
    frame.length = 8;
    for (int n = 0; n < kFramesPerCycle; ++n) {
      rig.nodes().bus.inject(frame);
    }
  };
  return effect;
}

/// Again and again: the port opens anew by itself.
template <class Kind>
SimEffect port_is(SimRig<Kind>& rig, CanPortState state, CanPortState afterwards) {
  SimEffect effect;
  effect.before_controller = [&rig, state] { rig.nodes().ecu_port.set_state(state); };
  effect.undo = [&rig, afterwards] { rig.nodes().ecu_port.set_state(afterwards); };
  return effect;
}

template <class Kind>
SimEffect bus_off(SimRig<Kind>& rig) {
  return port_is(rig, CanPortState::kBusOff, CanPortState::kBusOff);
}

template <class Kind>
SimEffect error_passive(SimRig<Kind>& rig) {
  return port_is(rig, CanPortState::kErrorPassive, CanPortState::kActive);
}

/// A port that was down is there again, and has to be opened.
template <class Kind>
SimEffect interface_down(SimRig<Kind>& rig) {
  return port_is(rig, CanPortState::kDown, CanPortState::kClosed);
}

template <class Kind>
SimEffect queue_full(SimRig<Kind>& rig) {
  return switched<Kind>(
      rig, [](typename Kind::Rig& nodes, bool on) { nodes.ecu_port.set_send_fails(on); });
}

}  // namespace

template <class Kind>
SimFaultRows<Kind> sim_bus_faults() {
  using R = SimReaction;
  return {
      {"babble", 24, "a babbling node fills the bus at top priority", R::kStopsUnheard,
       babble<Kind>},
      {"bus-off", 26, "the controller is bus-off", R::kStopsUnheard, bus_off<Kind>},
      {"error-passive", 27, "error-passive: nobody acknowledges", R::kStops, error_passive<Kind>},
      {"bus-down", 28, "the controller's interface is down", R::kStopsUnheard,
       interface_down<Kind>},
      {"queue-full", 29, "the controller's transmit queue is full", R::kStopsUnheard,
       queue_full<Kind>}};
}

template SimFaultRows<SimExcavator> sim_bus_faults();
template SimFaultRows<SimDozer> sim_bus_faults();

}  // namespace graben::scope
