// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The curves of all valve sections, the pumps' flow and the zeros of the pressure sensors, from
/// steady points: two equations a point.
///
/// 1. The drive's own, as the controller solves it: v = c_L(x) sqrt(F), (9) to (12), with F what
///    the pump's line leaves over the load, (33) to (35), at the measured speeds of all drives.
/// 2. That of the draining side, where no check valve is open: Q_out = C_d A_out(x) sqrt(2 p /
/// rho).
///
/// A valve of closed centre, whose pumps sense the load, has in the first one's place that of its
/// feeding side: the margin over A_in(x), which a compensator keeps, or no more than the pump has
/// left. What it gives is not measured: full swash at the engine's speed is the most.
///
/// One curve x -> opening serves both; factors on c_L (or A_in) and A_out are its own. Ceres,
/// robust loss, weak priors about the profile's values: what no point says stays where it was.

#include <functional>
#include <vector>

#include "app/identify/machine/estimate.hpp"
#include "app/identify/machine/steady_points.hpp"

namespace graben::identify {

/// What is known before of each value, as mean (in `start`) and standard deviation.
struct ValvePriors {
  double edge = 0.2;
  double log_softness = 0.8;
  double exponent = 0.3;
  double log_coefficient = 0.35;
  double log_out_area = 0.35;
  double zero_pa = 0.8e6;
  double pump_flow = 0.10;
  double log_closes_at = 0.12;
  double log_felt = 0.12;
};

/// Fits what the points support into `machine`, which comes with the profile's values and with
/// zeros of sensors that were found otherwise (`known`, their deviation is then the prior's).
void fit_valves(const DriveModel& model, const std::vector<SteadyPoint>& points,
                const ValvePriors& priors, MachineEstimate& machine);

}  // namespace graben::identify
