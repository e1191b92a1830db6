// SPDX-License-Identifier: Apache-2.0
#include "app/plant/energy_account.hpp"

#include <algorithm>

namespace graben::plant {

void EnergyAccount::add_pump(const Oil& oil, const PumpLine& pump, double step_s) {
  const PumpFlows& flows = pump.flows();
  const double at_pump = step_s * flow_energy_w(oil, flows.pump_port_pa);
  pump_j += pump.ideal_flow_m3ps() * at_pump;
  pump_leak_j += (pump.ideal_flow_m3ps() - flows.delivered_m3ps) * at_pump;
  pump_relief_j += (flows.delivered_m3ps - flows.line_in_m3ps) * at_pump;
  bypass_j += step_s * flows.bypass_m3ps * flow_energy_w(oil, flows.bypass_port_pa);
}

void EnergyAccount::add_section(const Oil& oil, const SectionPorts& ports,
                                const SectionFlows& flows, double step_s) {
  const auto energy = [&](const WavePort& port, double inflow_m3ps) {
    return flow_energy_w(oil, std::max(oil.boiling_pa, port.pressure_pa(inflow_m3ps)));
  };
  const double cap = energy(ports.cap, flows.cap_in_m3ps);
  const double rod = energy(ports.rod, flows.rod_in_m3ps);
  valve_j += step_s * (flows.supply_out_m3ps * energy(ports.supply, -flows.supply_out_m3ps) -
                       flows.recycle_in_m3ps * energy(ports.recycle, flows.recycle_in_m3ps) -
                       flows.cap_hose_m3ps * cap - flows.rod_hose_m3ps * rod);
  port_relief_j += step_s * ((flows.cap_hose_m3ps - flows.cap_in_m3ps) * cap +
                             (flows.rod_hose_m3ps - flows.rod_in_m3ps) * rod);
}

void EnergyAccount::add_chambers(const Oil& oil, const ChamberPower& power, double coulomb_w,
                                 double step_s) {
  piston_leak_j +=
      step_s * power.leak_m3ps * (flow_energy_w(oil, power.a_pa) - flow_energy_w(oil, power.b_pa));
  friction_j += step_s * (power.viscous_w - coulomb_w);
}

void EnergyAccount::add_piston(const Oil& oil, const PistonPower& power, double coulomb_n,
                               double velocity_mps, double step_s) {
  add_chambers(oil, power, coulomb_n * velocity_mps, step_s);
  end_stop_j += step_s * power.end_stop_w;
}

void EnergyAccount::add_motor(const Oil& oil, const ChamberPower& power, double coulomb_nm,
                              double rate_radps, double step_s) {
  add_chambers(oil, power, coulomb_nm * rate_radps, step_s);
}

}  // namespace graben::plant
