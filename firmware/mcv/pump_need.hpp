// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Unified pump control (future work 2 of Kim et al.): the flow that each pump has to give, instead
/// of the lambda that a given flow allows.

#include "firmware/mcv/circuit.hpp"

namespace graben {

/// What is asked of the circuit.
struct PumpAim {
  double lambda = 1.0;         ///< In (0, 1].
  double reserve_n = 0.0;      ///< Drive force that each moving axis is to have beyond its need,
  double reserve_share = 0.0;  ///< with so much of its load on top: what is heavy varies more.
  double most_pa = 0.0;        ///< A line is asked for no more pressure than this.
};

/// Flow at zero pressure, m^3/s, with which each line's balance (27), (28) ends at the pressure
/// that its most loaded axis needs, to move as wanted or back: for its load, F_offset or its spool
/// fully open, and the reserve. A line that nothing moves on needs none. Machine and input must
/// have passed their checks; the input's own flows don't matter.
[[nodiscard]] PerPump<double> needed_flow_m3ps(const McvMachine& machine, const McvInput& input,
                                               const PumpAim& aim);

}  // namespace graben
