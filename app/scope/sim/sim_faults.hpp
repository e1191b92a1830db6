// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The faults of each kind of machine, by their numbers in the table of faults, and the effects
/// that several of them have.

#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "app/runs/frame_edit.hpp"
#include "app/scope/sim/sim_rig.hpp"

namespace graben::scope {

template <class Kind>
using SimFaultRows = std::vector<SimFaultRow<Kind>>;

template <class Kind>
[[nodiscard]] SimFaultRows<Kind> sim_message_faults();  ///< 1 - 4, 6 - 10, 13 - 16
template <class Kind>
[[nodiscard]] SimFaultRows<Kind> sim_format_faults();  ///< 17 - 21
template <class Kind>
[[nodiscard]] SimFaultRows<Kind> sim_bus_faults();  ///< 24 - 29
template <class Kind>
[[nodiscard]] SimFaultRows<Kind> sim_machine_faults();  ///< 33 - 36
template <class Kind>
[[nodiscard]] SimFaultRows<Kind> sim_process_faults();  ///< 41 - 43, 46, 47
/// Those that each kind has in its own way, or not at all: 5, 22, 37 - 40.
[[nodiscard]] SimFaultRows<SimExcavator> sim_excavator_faults();
[[nodiscard]] SimFaultRows<SimDozer> sim_dozer_faults();

/// All of a kind, by their numbers.
template <class Kind>
[[nodiscard]] SimFaultRows<Kind> sim_faults();

/// Every live frame of a message goes through `change`; false loses it.
inline SimEffect tampered(std::uint32_t id, std::function<bool(CanFrame&)> change) {
  SimEffect effect;
  effect.tamper = [id, change = std::move(change)](CanFrame& frame, const LoopbackPort* from) {
    return frame.id != id || from == nullptr || change(frame);
  };
  return effect;
}

/// The same for the next one alone.
inline SimEffect tampered_once(std::uint32_t id, std::function<bool(CanFrame&)> change) {
  auto done = std::make_shared<bool>(false);
  SimEffect effect = tampered(id, [done, change = std::move(change)](CanFrame& frame) {
    return std::exchange(*done, true) || change(frame);
  });
  effect.is_over = [done] { return *done; };
  return effect;
}

/// What `set` does to the nodes now and, with false, when it is taken back.
template <class Kind>
SimEffect switched(SimRig<Kind>& rig, std::function<void(typename Kind::Rig&, bool on)> set) {
  set(rig.nodes(), true);
  SimEffect effect;
  effect.undo = [&rig, set = std::move(set)] { set(rig.nodes(), false); };
  return effect;
}

/// A value that is forced upon something, or none.
inline std::optional<double> forced(bool on, double value) {
  return on ? std::optional<double>(value) : std::nullopt;
}

/// A message of the machine's is not sent.
template <class Kind>
SimEffect silent(SimRig<Kind>& rig, std::uint32_t id) {
  return switched<Kind>(
      rig, [id](typename Kind::Rig& nodes, bool on) { nodes.plant.faults().set_silent(id, on); });
}

}  // namespace graben::scope
