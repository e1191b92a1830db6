// SPDX-License-Identifier: Apache-2.0
// The machine does not do, or does not show, what it was told.

#include "app/scope/sim/sim_faults.hpp"

namespace graben::scope {
namespace {

/// Wide open, against the way that the spool is open now.
template <class Kind>
double against(const typename Kind::Rig& nodes, unsigned axis) {
  constexpr double kOpen_ratio = 0.6;
  return Kind::spool_ratio(nodes, axis) > 0.0 ? -kOpen_ratio : kOpen_ratio;
}

template <class Kind>
SimEffect spool_held(SimRig<Kind>& rig) {
  const unsigned axis = Kind::moving_axis(rig.nodes());
  const double held = against<Kind>(rig.nodes(), axis);
  return switched<Kind>(rig, [axis, held](typename Kind::Rig& nodes, bool on) {
    Kind::axis(nodes, axis).spool_held_ratio = forced(on, held);
  });
}

template <class Kind>
SimEffect spool_moves(SimRig<Kind>& rig) {
  const unsigned axis = Kind::moving_axis(rig.nodes());
  const double beyond = against<Kind>(rig.nodes(), axis);
  return switched<Kind>(rig, [axis, beyond](typename Kind::Rig& nodes, bool on) {
    Kind::axis(nodes, axis).spool_offset_ratio = on ? beyond : 0.0;
  });
}

template <class Kind>
SimEffect stroke_stuck(SimRig<Kind>& rig) {
  const unsigned axis = Kind::moving_axis(rig.nodes());
  return switched<Kind>(rig, [axis](typename Kind::Rig& nodes, bool on) {
    Kind::axis(nodes, axis).stroke.stuck = on;
  });
}

template <class Kind>
SimEffect stroke_jumps(SimRig<Kind>& rig) {
  constexpr double kJump_m = 0.15;
  return switched<Kind>(rig, [](typename Kind::Rig& nodes, bool on) {
    Kind::axis(nodes, 0).stroke.jump_m = on ? kJump_m : 0.0;
  });
}

}  // namespace

template <class Kind>
SimFaultRows<Kind> sim_machine_faults() {
  using R = SimReaction;
  return {
      {"spool-held", 33, "a spool is stuck open against its command", R::kStops, spool_held<Kind>},
      {"spool-moves", 34, "a spool opens beyond its command", R::kStops, spool_moves<Kind>},
      {"stroke-stuck", 35, "the stroke sensor of a moving cylinder is stuck", R::kStops,
       stroke_stuck<Kind>},
      {"stroke-jumps", 36, std::string(Kind::kStrokeWords) + " jumps by 150 mm", R::kStops,
       stroke_jumps<Kind>}};
}

template SimFaultRows<SimExcavator> sim_machine_faults();
template SimFaultRows<SimDozer> sim_machine_faults();

}  // namespace graben::scope
