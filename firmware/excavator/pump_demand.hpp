#pragma once
/// Swash on demand: as much of each pump as the wanted motion, the loads and the engine's speed ask
/// for, no more.

#include "firmware/excavator/excavator_profile.hpp"
#include "firmware/mcv/mcv_machine.hpp"

namespace graben {

/// State from cycle to cycle.
struct PumpDemand {
  std::array<double, kPumpCount> swash_ratio{};  ///< Last commanded.
};

/// A cycle on. `input` has the wanted speeds without corrections, and filtered loads. Not `active`,
/// and where the profile has no range for it, the swash is that of the task.
void next_pump_demand(const ExcavatorProfile& profile, const McvMachine& valve,
                      const McvInput& input, double engine_radps, bool active, double period_s,
                      PumpDemand& demand);

}  // namespace graben
