// SPDX-License-Identifier: Apache-2.0
#include "app/scope/sim/sim_faults.hpp"

#include <algorithm>

namespace graben::scope {
namespace {

SimFaultRows<SimExcavator> own_faults(const SimExcavator&) { return sim_excavator_faults(); }
SimFaultRows<SimDozer> own_faults(const SimDozer&) { return sim_dozer_faults(); }

}  // namespace

const char* reaction_words(SimReaction reaction) {
  switch (reaction) {
    case SimReaction::kStops:
      return "stops, and stays stopped until re-armed";
    case SimReaction::kStopsUnheard:
      return "no command gets out: the valve side closes by itself; stays stopped until re-armed";
    case SimReaction::kLetsGo:
      return "stops in the same cycle; goes on only by a fresh enable";
    case SimReaction::kRefused:
      return "does not arm, and says why";
    case SimReaction::kSlower:
      return "goes on slower";
    case SimReaction::kIgnored:
      return "goes on; refused and counted";
    case SimReaction::kBridged:
      return "goes on as before";
  }
  return "";
}

template <class Kind>
SimFaultRows<Kind> sim_faults() {
  SimFaultRows<Kind> rows;
  for (const SimFaultRows<Kind>& some :
       {sim_message_faults<Kind>(), sim_format_faults<Kind>(), sim_bus_faults<Kind>(),
        sim_machine_faults<Kind>(), sim_process_faults<Kind>(), own_faults(Kind{})}) {
    rows.insert(rows.end(), some.begin(), some.end());
  }
  std::stable_sort(rows.begin(), rows.end(),
                   [](const auto& a, const auto& b) { return a.number < b.number; });
  return rows;
}

template SimFaultRows<SimExcavator> sim_faults();
template SimFaultRows<SimDozer> sim_faults();

}  // namespace graben::scope
