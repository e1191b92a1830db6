// SPDX-License-Identifier: Apache-2.0
#include "app/identify/machine/falling_flow.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/mcv/regulated.hpp"
#include "firmware/mcv/work.hpp"

namespace graben::identify {

double bypass_at(const McvActuator& actuator, double closes_at, double opening) {
  if (opening == 0.0) {
    return actuator.bypass_open;
  }
  const double closed = closes_at > 0.0 ? std::min(1.0, opening / closes_at) : 1.0;
  return actuator.bypass_open + closed * (actuator.bypass_closed - actuator.bypass_open);
}

double falling_flow_left(const FlowBalance& line, double sqrt_pa) {
  const PumpRegulator& by = line.regulated->regulator;
  const double root = sqrt_pa * line.bypass / line.regulated->tank_orifice;
  const double gone = std::clamp(
      (root * root - by.full_swash_pa) / (by.least_swash_pa - by.full_swash_pa), 0.0, 1.0);
  FlowBalance now = line;
  now.flow_m3ps *= 1.0 - (1.0 - by.least_swash_ratio) * gone;
  return flow_left(now, 1.0, sqrt_pa);
}

double falling_sqrt_pressure(const FlowBalance& line, double felt_factor) {
  McvPump pump = *line.regulated;
  pump.regulator.full_swash_pa *= felt_factor;
  pump.regulator.least_swash_pa *= felt_factor;
  FlowBalance tried = line;
  tried.regulated = &pump;
  // Many more than it takes.
  Work work{1000};
  tried.work = &work;
  const PumpPressure solved = most_pressure(tried, 1.0);
  return solved.fed ? solved.sqrt_pressure : 0.0;
}

}  // namespace graben::identify
