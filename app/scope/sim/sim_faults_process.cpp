// SPDX-License-Identifier: Apache-2.0
// The controller's own time, and whom it answers.

#include "app/scope/sim/sim_faults.hpp"

namespace graben::scope {
namespace {

/// The controller's cycle is not called for so many of the machine's.
SimEffect cycles_left_out(int cycles) {
  auto left = std::make_shared<int>(cycles);
  SimEffect effect;
  effect.controller_runs = [left] { return (*left)-- <= 0; };
  effect.is_over = [left] { return *left <= 0; };
  return effect;
}

template <class Kind>
SimEffect cycle_late(SimRig<Kind>& /*rig*/) {
  return cycles_left_out(1);
}

template <class Kind>
SimEffect stalls(SimRig<Kind>& /*rig*/) {
  return cycles_left_out(30);
}

template <class Kind>
SimEffect killed(SimRig<Kind>& rig) {
  constexpr int kAwayCycles = 100;
  rig.nodes().ecu.reset();
  SimEffect effect = cycles_left_out(kAwayCycles);
  effect.undo = [&rig] { static_cast<void>(rig.nodes().start_ecu()); };
  return effect;
}

template <class Kind>
SimEffect wrong_identity(SimRig<Kind>& rig) {
  return switched<Kind>(
      rig, [](typename Kind::Rig& nodes, bool on) { nodes.plant.faults().wrong_identity = on; });
}

/// The operator gives the task all the time, also while he lets go and enables again, which he
/// tries again and again.
template <class Kind>
SimEffect task_not_at_rest(SimRig<Kind>& rig) {
  constexpr int kLetGoCycles = 50;
  constexpr int kTryCycles = 150;
  SimEffect effect;
  effect.operator_does = [&rig, cycle = 0](plant::OperatorRequest& request) mutable {
    request.task = rig.task();
    request.enable = cycle++ % kTryCycles >= kLetGoCycles;
  };
  return effect;
}

}  // namespace

template <class Kind>
SimFaultRows<Kind> sim_process_faults() {
  using R = SimReaction;
  return {
      {"cycle-late", 41, "one cycle of the controller is left out", R::kBridged, cycle_late<Kind>,
       true},
      {"controller-stalls", 42, "the controller stalls for 0.3 s", R::kStopsUnheard, stalls<Kind>,
       true},
      {"controller-killed", 43, "the controller is killed, and starts again after 1 s",
       R::kStopsUnheard, killed<Kind>, true},
      {"identity-wrong", 46, "the machine names another profile", R::kStops, wrong_identity<Kind>},
      {"task-not-at-rest", 47, "enable is given again with the task chosen already", R::kRefused,
       task_not_at_rest<Kind>}};
}

template SimFaultRows<SimExcavator> sim_process_faults();
template SimFaultRows<SimDozer> sim_process_faults();

}  // namespace graben::scope
