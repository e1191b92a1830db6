// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the optimiser is checked against: the circuit of Kim et al. once more, written from the
/// equations, one halving at a time, and with nothing of firmware/mcv but its structs; random
/// valves and inputs (1 to 6 spools on 1 to 3 pumps, regeneration on either side or none); what
/// must hold of a solution whatever went in.

#include <cstdint>
#include <string>

#include "firmware/mcv/mcv_machine.hpp"
#include "firmware/mcv/optimiser.hpp"

namespace graben::test {

/// What the circuit does at one lambda.
struct PlainPoint {
  /// Smallest margin of all constraints as a share of the numbers that it is the difference of;
  /// below 0: infeasible.
  double margin = 0.0;
  PerPump<double> pump_pressure_pa{};
  PerActuator<double> out_pressure_pa{};
  PerActuator<double> coefficient{};  ///< c_L that each spool needs.
};

[[nodiscard]] PlainPoint plain_point(const McvMachine& machine, const McvInput& input,
                                     double lambda);

/// c_L of a table at |x|, by its points.
[[nodiscard]] double plain_coefficient(const MonotoneTable& table, double travel_m);

struct RandomCase {
  McvMachine machine;
  McvInput input;
};

/// The same seed gives the same case everywhere. Flows, loads and valves are drawn so wide and so
/// correlated that every limit, and gaps in the feasible set, occur often.
[[nodiscard]] RandomCase random_case(std::uint64_t seed);

/// Empty, or in words what is unsafe: a number that is not finite, a lambda out of its range, a
/// spool that is open too far, the wrong way or without a solution behind it, bad input that went
/// through or good input that did not.
[[nodiscard]] std::string unsafe(const McvMachine& machine, const McvInput& input,
                                 const LambdaRange& range, const McvSolution& solution);

}  // namespace graben::test
