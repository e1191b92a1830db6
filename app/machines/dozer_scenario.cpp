#include "app/machines/dozer_scenario.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace graben::machines {

DozerMachine arranged(DozerMachine machine, const DozerScenario& scenario) {
  if (scenario.errors) {
    machine.plant = draw_dozer(machine, scenario.seed);
  }
  if (scenario.engine_radps) {
    HstProfile& hst = machine.plant.machine.hst;
    if (*scenario.engine_radps < hst.engine_least_radps ||
        *scenario.engine_radps > hst.engine_most_radps) {
      throw std::runtime_error(
          fmt::format("an engine speed of {:.2f} rad/s; the profile allows {} .. {} rad/s",
                      *scenario.engine_radps, hst.engine_least_radps, hst.engine_most_radps));
    }
    hst.engine_radps = *scenario.engine_radps;
  }
  TravelProfile& travel = machine.profile.travel;
  travel.policy = scenario.policy;
  travel.speed_desired_mps = scenario.speed_mps.value_or(travel.speed_desired_mps);
  // v_min is what a limit may not go below, not what the operator may not.
  travel.speed_min_mps = std::min(travel.speed_min_mps, travel.speed_desired_mps);
  return machine;
}

}  // namespace graben::machines
