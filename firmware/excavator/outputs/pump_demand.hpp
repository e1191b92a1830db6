// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Swash on demand: as much of each pump as the wanted motion, the loads and the engine's speed ask
/// for, no more.

#include "firmware/excavator/excavator_profile.hpp"
#include "firmware/mcv/mcv_machine.hpp"

namespace graben {

/// State from cycle to cycle.
struct PumpDemand {
  std::array<double, kPumpCount> swash_ratio{};  ///< Last commanded.
  /// More than the model says: its drives fall short, as where a bypass is more open than it says.
  std::array<double, kPumpCount> short_ratio{};
};

/// What the pumps are asked for.
struct PumpAsk {
  McvInput input;             ///< The wanted speeds without corrections, and filtered loads.
  PerPump<double> line_pa{};  ///< What each line is expected to be at.
  double engine_radps = 0.0;
  PerPump<double> short_share{};  ///< Of the wanted speed, of the drive that lacks most of it.
  bool active = false;
  bool blocked = false;        ///< A load holds a drive: more flow would only squeeze more oil.
  double reserve_ratio = 1.0;  ///< On control.lambda_rise_reserve, see reserve_ratio().
};

/// A cycle on. Not active, and where the profile has no range for it, the swash is that of the
/// task; blocked, it is no more than that. All pumps together take no more than the profile's
/// power.
void next_pump_demand(const ExcavatorProfile& profile, const McvMachine& valve, const PumpAsk& ask,
                      double period_s, PumpDemand& demand);

}  // namespace graben
