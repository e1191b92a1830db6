// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How a drive of the blade answers its spool: a section whose inlet meters the flow whatever the
/// load, up to what the pump gives.

#include <array>
#include <cstddef>
#include <vector>

#include "app/identify/dozer/dozer_estimate.hpp"
#include "app/identify/dozer/dozer_log.hpp"
#include "firmware/dozer/dozer_profile.hpp"

namespace graben::identify {

/// Of the drive, from its profile.
struct BladeMachine {
  double extend_area_m2 = 0.0;  ///< Fed as it extends.
  double retract_area_m2 = 0.0;
  double stroke_m = 0.0;
  double valve_flow_m3ps = 0.0;  ///< As the profile has it.
  double pump_m3prad = 0.0;      ///< The same, per radian of the engine.
};

/// Lift (0) or tilt (1) of the profile.
[[nodiscard]] BladeMachine blade_machine(const DozerProfile& profile, std::size_t drive);

struct BladeFit {
  BladeDriveEstimate drive;
  Estimate pump_flow_factor;  ///< Known where the pump's flow was all that a side got.
};

/// From logs in which the drive moved. `pump_flow_factor`: what another drive has shown of the
/// pump, or not known.
[[nodiscard]] BladeFit fit_blade(const std::vector<DozerLog>& logs, std::size_t drive,
                                 const BladeMachine& machine, const Estimate& pump_flow_factor);

}  // namespace graben::identify
