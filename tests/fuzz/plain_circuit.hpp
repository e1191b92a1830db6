#pragma once
/// The circuit of Kim et al. once more, for checking the core: written from the equations, one
/// halving at a time, and with nothing of firmware/mcv but its structs.

#include "firmware/mcv/mcv_machine.hpp"

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

}  // namespace graben::test
