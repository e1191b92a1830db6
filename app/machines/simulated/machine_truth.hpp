// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a perfect identification of a simulated excavator would find.

#include <array>
#include <utility>
#include <vector>

#include "app/plant/excavator_plant_profile.hpp"

namespace graben::machines {

/// One direction of a drive. Ratios are of the spool's travel, and so of the duty's magnitude.
struct SideTruth {
  double edge_ratio = 0.0;      ///< Where the power law behind a soft edge begins.
  double softness_ratio = 0.0;  ///< Of the travel, half of it before the edge; see SpoolSide.
  double start_ratio = 0.0;     ///< Where the first oil passes.
  double opening_exponent = 0.0;
  /// Duty and the share of the full areas that is open there once the spool has arrived: rising
  /// from (start, 0) to (1, 1), close together where it bends.
  std::vector<std::pair<double, double>> opening;
  double dead_time_s = 0.0;  ///< From a duty in the valve's hands to the spool's first movement.
  double lag_s = 0.0;  ///< Mean delay of spool (2 damping time_constant) and pilot, behind it.
  /// The same chain as a dead time and one first-order lag (half rule: the largest lag and half of
  /// the second stay a lag, the rest is dead time). Their sum is that of the above.
  double first_order_dead_time_s = 0.0;
  double first_order_lag_s = 0.0;
  double in_m2 = 0.0;  ///< Full metering areas.
  double out_m2 = 0.0;
};

struct DriveTruth {
  SideTruth extend;
  SideTruth retract;
  double stroke_zero_m = 0.0;  ///< Measured less true; 0 of the swing.
  double cap_zero_pa = 0.0;    ///< Of the swing the left port.
  double rod_zero_pa = 0.0;
};

/// Of the plant alone; what its sensors' seed draws beside it is left out.
struct MachineTruth {
  std::array<DriveTruth, kDriveCount> drive;  ///< Of a swing that is not driven: means nothing.
  std::array<double, kPumpCount> pump_flow_factor{};  ///< On the nominal displacement.
  double bulk_modulus_pa = 0.0;
  std::array<PumpRegulator, kPumpCount> regulator;  ///< Of pumps that set their own swash.
  /// Share of the travel behind its start after which a bypass is closed; 0: wherever it is open.
  double bypass_closes_at = 0.0;
};

[[nodiscard]] MachineTruth truth_of(const plant::ExcavatorPlantProfile& plant);

}  // namespace graben::machines
