// SPDX-License-Identifier: Apache-2.0
#include "app/plant/dozer_implement.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/numeric/constants.hpp"

namespace graben::plant {

ImplementSection lift_section(const DozerPlantProfile& profile) {
  const BladeGeometry& blade = profile.machine.blade;
  // Extension lowers the blade.
  const BladeValve valve = profile.valve(0);
  return {valve.spool, valve.flow_factor * profile.machine.implement.valve_flow_max_m3ps,
          piston_areas(blade.cylinder_count, blade.bore_m, blade.rod_m),
          profile.lowering_back_pressure_pa, profile.raising_back_pressure_pa};
}

ImplementSection tilt_section(const DozerPlantProfile& profile) {
  const TiltProfile& tilt = profile.machine.tilt;
  const BladeValve valve = profile.valve(1);
  return {valve.spool, valve.flow_factor * tilt.valve_flow_max_m3ps,
          piston_areas(tilt.cylinder_count, tilt.bore_m, tilt.rod_m), profile.tilt_back_pressure_pa,
          profile.tilt_back_pressure_pa};
}

ImplementCircuit::ImplementCircuit(const DozerPlantProfile& profile,
                                   const ImplementSection& section)
    : spool_(section.spool),
      protection_(profile.protection(profile.port_relief_pa)),
      relief_(profile.implement_relief_pa),
      flow_max_(section.flow_max_m3ps) {
  const ImplementProfile& implement = profile.machine.implement;
  pump_m3prad_ = implement.displacement_m3prev * implement.efficiency / kTwoPi;
  const PistonAreas& area = section.area;
  k_in_ = flow_max_ / std::sqrt(profile.compensator_margin_pa);
  k_extending_ =
      flow_max_ * area.rod_m2 / area.cap_m2 / std::sqrt(section.extending_back_pressure_pa);
  k_retracting_ =
      flow_max_ * area.cap_m2 / area.rod_m2 / std::sqrt(section.retracting_back_pressure_pa);
}

double ImplementCircuit::supply(double k_in, const WavePort& fed) const {
  const double at_relief = orifice_flow(k_in, {relief_, 0.0}, fed);
  return std::max(0.0, std::min({flows_.demand, flows_.available, at_relief}));
}

const ImplementFlows& ImplementCircuit::solve(double available_m3ps, const WavePort& cap,
                                              const WavePort& rod) {
  const double opening = spool_.area_ratio();
  const bool extends = spool_.travel_ratio() > 0.0;
  flows_.demand = opening * flow_max_;
  flows_.available = available_m3ps;
  const double fed_in = protected_flow(extends ? cap : rod, protection_, [&](const WavePort& fed) {
    return flows_.supply = supply(opening * k_in_, fed);
  });
  const double k_out = flows_.supply / flow_max_ * (extends ? k_extending_ : k_retracting_);
  const double drained_in =
      protected_flow(extends ? rod : cap, protection_,
                     [&](const WavePort& drained) { return -orifice_flow(k_out, drained, kTank); });
  flows_.cap_in = extends ? fed_in : drained_in;
  flows_.rod_in = extends ? drained_in : fed_in;
  return flows_;
}

}  // namespace graben::plant
