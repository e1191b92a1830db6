#pragma once
/// The faults of each kind of machine, by their numbers in the table of faults.

#include <vector>

#include "app/scope/sim/sim_rig.hpp"

namespace graben::scope {

template <class Kind>
using SimFaultRows = std::vector<SimFaultRow<Kind>>;

template <class Kind>
[[nodiscard]] SimFaultRows<Kind> sim_message_faults();  ///< 1 - 4, 6 - 10, 13 - 16
template <class Kind>
[[nodiscard]] SimFaultRows<Kind> sim_format_faults();  ///< 17 - 21
template <class Kind>
[[nodiscard]] SimFaultRows<Kind> sim_bus_faults();  ///< 24 - 29
template <class Kind>
[[nodiscard]] SimFaultRows<Kind> sim_machine_faults();  ///< 33 - 36
template <class Kind>
[[nodiscard]] SimFaultRows<Kind> sim_process_faults();  ///< 41 - 43, 46, 47
/// Those that each kind has in its own way, or not at all: 5, 22, 37 - 40.
[[nodiscard]] SimFaultRows<SimExcavator> sim_excavator_faults();
[[nodiscard]] SimFaultRows<SimDozer> sim_dozer_faults();

/// All of a kind, by their numbers.
template <class Kind>
[[nodiscard]] SimFaultRows<Kind> sim_faults();

}  // namespace graben::scope
