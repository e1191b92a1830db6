// SPDX-License-Identifier: Apache-2.0
// What each kind of machine has in its own way, or not at all.

#include "app/scope/sim/sim_faults.hpp"

namespace graben::scope {
namespace {

constexpr double kShownSwash_ratio = 1.0;  // More than digging asks for, but in heavy soil.
constexpr double kTooFast_mps = 1.0;

/// Beyond any range that these messages have, and no special value.
template <class Kind>
SimEffect out_of_range(std::uint32_t id, const dbc::Field& field) {
  constexpr std::uint32_t kBeyond = 0x80;
  return tampered(id, [field](CanFrame& frame) {
    runs::set_raw<Kind>(frame, field, field.raw_max + kBeyond);
    return true;
  });
}

using BoomPressure = dbc::excavator::BoomPressure;

SimEffect pressure_silent(SimRig<SimExcavator>& rig) { return silent(rig, BoomPressure::kId); }

SimEffect pressure_out_of_range(SimRig<SimExcavator>& /*rig*/) {
  return out_of_range<SimExcavator>(BoomPressure::kId, BoomPressure::kBoomCapPressure);
}

SimEffect pressure_at_rail(SimRig<SimExcavator>& rig) {
  const double rail_pa = rig.nodes().setup.profile.safety.pressure_rail_pa;
  return switched<SimExcavator>(rig, [rail_pa](SimExcavator::Rig& nodes, bool on) {
    nodes.plant.faults().axis[kBoom].cap.rail_pa = forced(on, rail_pa);
  });
}

SimEffect swash_wrong(SimRig<SimExcavator>& rig) {
  return switched<SimExcavator>(rig, [](SimExcavator::Rig& nodes, bool on) {
    nodes.plant.faults().pump[0].shown_swash_ratio = forced(on, kShownSwash_ratio);
  });
}

SimEffect engine_out_of_range(SimRig<SimDozer>& /*rig*/) {
  return out_of_range<SimDozer>(SimDozer::Dbc::EEC1::kId, SimDozer::Dbc::EEC1::kEngineSpeed);
}

/// The servo stays where it is: what it is told next it does not reach.
SimEffect displacement_stuck(SimRig<SimDozer>& rig) {
  const double ratio = rig.nodes().plant.plant().pump_ratios()[kLeft];
  return switched<SimDozer>(rig, [ratio](SimDozer::Rig& nodes, bool on) {
    nodes.plant.faults().path[kLeft].pump.held_ratio = forced(on, ratio);
  });
}

SimEffect displacement_reversed(SimRig<SimDozer>& rig) {
  return switched<SimDozer>(rig, [](SimDozer::Rig& nodes, bool on) {
    nodes.plant.faults().path[kLeft].pump.reversed = on;
  });
}

SimEffect track_speed_wrong(SimRig<SimDozer>& rig) {
  return switched<SimDozer>(rig, [](SimDozer::Rig& nodes, bool on) {
    nodes.plant.faults().path[kLeft].speed.jump = on ? kTooFast_mps : 0.0;
  });
}

}  // namespace

SimFaultRows<SimExcavator> sim_excavator_faults() {
  using R = SimReaction;
  return {{"pressure-silent", 5, "the boom pressures' frames stop", R::kSlower, pressure_silent},
          {"out-of-range", 22, "a boom pressure is out of its range, its CRC right", R::kSlower,
           pressure_out_of_range},
          {"pressure-rail", 37, "a boom pressure is at its sensor's rail", R::kSlower,
           pressure_at_rail},
          {"swash-disagrees", 38, "the first pump's swash feedback disagrees", R::kSlower,
           swash_wrong}};
}

SimFaultRows<SimDozer> sim_dozer_faults() {
  using R = SimReaction;
  return {{"out-of-range", 22, "the engine's speed is out of its range", R::kSlower,
           engine_out_of_range},
          {"displacement-stuck", 38, "the left pump's displacement stays where it is", R::kStops,
           displacement_stuck},
          {"displacement-reversed", 39, "the left pump runs away to the other side", R::kStops,
           displacement_reversed},
          {"track-speed", 40, "the left track's speed reads 1 m/s too much", R::kSlower,
           track_speed_wrong}};
}

}  // namespace graben::scope
