// SPDX-License-Identifier: Apache-2.0
#include "app/built/machine_edge.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <variant>

namespace graben::built {

double width_of(double profile_m, double told_m, const char* key) {
  if (profile_m > 0.0 && told_m > 0.0) {
    throw std::runtime_error(fmt::format(
        "--width {}: the profile says {} m ({}); allowed: one of the two", told_m, profile_m, key));
  }
  if (profile_m <= 0.0 && told_m <= 0.0) {
    throw std::runtime_error(
        fmt::format("the profile does not say how wide the edge is ({}): --width M says it", key));
  }
  return profile_m > 0.0 ? profile_m : told_m;
}

std::unique_ptr<MachineEdge> machine_edge(const machines::AnyMachine& machine, double width_m) {
  if (const auto* excavator = std::get_if<machines::ExcavatorMachine>(&machine)) {
    return excavator_edge(*excavator, width_m);
  }
  return dozer_edge(std::get<machines::DozerMachine>(machine), width_m);
}

}  // namespace graben::built
