// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A simulated machine as a perfect identification would find it, and how far a real one is off.

#include "app/identify/machine/estimate.hpp"
#include "app/machines/simulated/machine_truth.hpp"
#include "app/runs/drive_speeds.hpp"
#include "firmware/excavator/excavator_profile.hpp"

namespace graben::runs {

/// The truth in the terms of an estimate: everything is known, and nothing is open.
[[nodiscard]] identify::MachineEstimate known_machine(const ExcavatorProfile& profile,
                                                      const machines::MachineTruth& truth);

/// Largest errors of what was found, over all drives and directions.
struct IdentificationErrors {
  double edge_ratio = 0.0;  ///< Of the travel at which a two-hundredth of the area is open.
  double dead_time_s = 0.0;
  double lag_s = 0.0;
  double stroke_zero_m = 0.0;
  double pressure_zero_pa = 0.0;
  double pump_flow = 0.0;  ///< As a share.
  SpeedErrors speed;       ///< Of full speed.
  int values = 0;          ///< With a stated deviation ...
  int within = 0;          ///< ... and the truth within 1.96 of them.

  [[nodiscard]] double within_share() const {
    return values > 0 ? static_cast<double>(within) / values : 0.0;
  }
};

[[nodiscard]] IdentificationErrors errors_of(const ExcavatorProfile& profile,
                                             const identify::MachineEstimate& found,
                                             const machines::MachineTruth& truth);

}  // namespace graben::runs
