// SPDX-License-Identifier: Apache-2.0
#include "app/plant/dozer_implement.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/numeric/constants.hpp"

namespace graben::plant {

ImplementCircuit::ImplementCircuit(const DozerPlantProfile& profile)
    : spool_(profile.spool_dynamics()),
      protection_(profile.protection(profile.port_relief_pa)),
      relief_(profile.implement_relief_pa),
      flow_max_(profile.machine.implement.valve_flow_max_m3ps) {
  const ImplementProfile& implement = profile.machine.implement;
  pump_m3prad_ = implement.displacement_m3prev * implement.efficiency / kTwoPi;
  const BladeGeometry& blade = profile.machine.blade;
  const PistonAreas area = piston_areas(blade.cylinder_count, blade.bore_m, blade.rod_m);
  k_in_ = flow_max_ / std::sqrt(profile.compensator_margin_pa);
  k_lowering_ =
      flow_max_ * area.rod_m2 / area.cap_m2 / std::sqrt(profile.lowering_back_pressure_pa);
  k_raising_ = flow_max_ * area.cap_m2 / area.rod_m2 / std::sqrt(profile.raising_back_pressure_pa);
}

double ImplementCircuit::supply(double k_in, const WavePort& fed) const {
  const double at_relief = orifice_flow(k_in, {relief_, 0.0}, fed);
  return std::max(0.0, std::min({flows_.demand, flows_.available, at_relief}));
}

const ImplementFlows& ImplementCircuit::solve(double engine_radps, const WavePort& cap,
                                              const WavePort& rod) {
  const double opening = spool_.area_ratio();
  const bool lowers = spool_.travel_ratio() > 0.0;
  flows_.demand = opening * flow_max_;
  flows_.available = pump_flow_m3ps(engine_radps);
  const double fed_in = protected_flow(lowers ? cap : rod, protection_, [&](const WavePort& fed) {
    return flows_.supply = supply(opening * k_in_, fed);
  });
  const double k_out = flows_.supply / flow_max_ * (lowers ? k_lowering_ : k_raising_);
  const double drained_in =
      protected_flow(lowers ? rod : cap, protection_,
                     [&](const WavePort& drained) { return -orifice_flow(k_out, drained, kTank); });
  flows_.cap_in = lowers ? fed_in : drained_in;
  flows_.rod_in = lowers ? drained_in : fed_in;
  return flows_;
}

}  // namespace graben::plant
