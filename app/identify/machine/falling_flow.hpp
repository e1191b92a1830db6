// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A line under negative flow control as identification takes it: its bypass by the openings, and
/// the swash by the pressure before the bypass' last orifice (mcv/regulated.hpp).

#include "firmware/mcv/circuit.hpp"

namespace graben::identify {

/// Flow coefficient of one spool's bypass at its opening, m^3/(s sqrt(Pa)): it closes evenly up to
/// the opening `closes_at`, or with any opening where that is 0.
[[nodiscard]] double bypass_at(const McvActuator& actuator, double closes_at, double opening);

/// Flow that is left in a line at a pressure, once the swash is where that pressure leads it; falls
/// as the pressure rises. `line` has the flow of full swash and the bypass as it is.
[[nodiscard]] double falling_flow_left(const FlowBalance& line, double sqrt_pa);

/// sqrt of the pressure at which nothing is left, with both of the regulator's pressures times
/// `felt_factor`; 0 where the line takes more than full swash gives.
[[nodiscard]] double falling_sqrt_pressure(const FlowBalance& line, double felt_factor);

}  // namespace graben::identify
