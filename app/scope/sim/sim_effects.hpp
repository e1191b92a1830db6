#pragma once
/// Effects that several of the simulation's faults have.

#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "app/runs/frame_edit.hpp"
#include "app/scope/sim/sim_rig.hpp"

namespace graben::scope {

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
