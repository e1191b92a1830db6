// SPDX-License-Identifier: Apache-2.0
#include "app/plant/chamber_pair.hpp"

namespace graben::plant {

ChamberPair::ChamberPair(const ChamberPairData& data, double step_s)
    : a_(2, data.oil, step_s),
      b_(2, data.oil, step_s),
      a_displacement_(data.a_displacement),
      b_displacement_(data.b_displacement),
      leak_(data.leak_m3pspa),
      boiling_(data.oil.boiling_pa) {}

void ChamberPair::start(double a_volume_m3, double a_pa, double b_volume_m3, double b_pa) {
  a_.start(a_volume_m3, a_pa);
  b_.start(b_volume_m3, b_pa);
}

WavePort ChamberPair::wall_port(const WaveVolume& chamber, double last_inflow_m3ps) const {
  const WavePort port = chamber.port(kWall);
  return port.pressure_pa(last_inflow_m3ps) < boiling_ ? WavePort{boiling_, 0.0} : port;
}

ChamberLoads ChamberPair::load(double velocity) const {
  const double leak = leak_m3ps();
  const WavePort a = wall_port(a_, -a_displacement_ * velocity - leak);
  const WavePort b = wall_port(b_, b_displacement_ * velocity + leak);
  return {{a_displacement_ * a.pressure_pa(-leak),
           a_displacement_ * a_displacement_ * a.impedance_paspm3},
          {b_displacement_ * b.pressure_pa(leak),
           b_displacement_ * b_displacement_ * b.impedance_paspm3}};
}

ChamberPower ChamberPair::power(double velocity, double mean_velocity) const {
  const double leak = leak_m3ps();
  ChamberPower power;
  power.a_pa = wall_port(a_, -a_displacement_ * velocity - leak)
                   .pressure_pa(-a_displacement_ * mean_velocity - leak);
  power.b_pa = wall_port(b_, b_displacement_ * velocity + leak)
                   .pressure_pa(b_displacement_ * mean_velocity + leak);
  power.leak_m3ps = leak;
  return power;
}

void ChamberPair::step(double a_in_m3ps, double b_in_m3ps, double mean_velocity) {
  const double leak = leak_m3ps();
  a_.set_flow(kValve, a_in_m3ps);
  a_.set_flow(kWall, -a_displacement_ * mean_velocity - leak);
  a_.scatter();
  b_.set_flow(kValve, b_in_m3ps);
  b_.set_flow(kWall, b_displacement_ * mean_velocity + leak);
  b_.scatter();
}

}  // namespace graben::plant
