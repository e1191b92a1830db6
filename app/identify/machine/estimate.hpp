// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What is found of a machine from its logs, each value with its standard deviation. SI units;
/// ratios of duty and spool are of the full travel.

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "firmware/excavator/excavator_signals.hpp"

namespace graben::identify {

/// A value that was found, or the one that was there before.
struct Estimate {
  double value = 0.0;
  double deviation = 0.0;  ///< Standard deviation; of what is not known, that of not knowing.
  bool known = false;      ///< The log says it; else the old value stays.
};

/// How one side of a valve opens: metering area over its full area at travel x is
/// opening(x) ^ exponent, with opening(x) = w ln(1 + exp((x - edge) / w)), scaled to 1 at x = 1.
struct OpeningCurve {
  double edge = 0.0;
  double softness = 0.0;  ///< w
  double exponent = 1.0;

  /// Travel before which nothing is open, as good as.
  [[nodiscard]] double start() const { return std::max(0.0, edge - 2.0 * softness); }
  /// Share of the full area at a travel of 0 .. 1.
  [[nodiscard]] double area_ratio(double travel) const;
  /// Travel at which so much of the full area is open, 0 .. 1.
  [[nodiscard]] double travel_at(double area_ratio) const;
};

/// Openings of the profile's model (its area ratio is opening ^ valve.opening_exponent) at which a
/// duty table is made; the first stands for the edge.
inline constexpr std::array<double, 10> kTableOpenings = {0.01, 0.03, 0.06, 0.12, 0.2,
                                                          0.32, 0.46, 0.62, 0.8,  1.0};

/// Of one drive and direction.
struct SideEstimate {
  Estimate edge;
  Estimate softness;
  Estimate exponent;
  Estimate coefficient_factor;  ///< Of the profile's velocity coefficient c_L, (9) and (11).
  Estimate out_area_factor;     ///< Of the profile's area on the draining side.
  double in_area_factor = 1.0;  ///< With load sensing, of its feeding side; see coefficient_of().
  Estimate dead_time_s;
  /// With negative flow: travel at which the bypass is closed, evenly from the curve's start on; 0:
  /// not known.
  double bypass_closed_at = 0.0;
  double driven_least = 0.0;  ///< Least and most duty that moved it; both 0: none did.
  double driven_most = 0.0;
  /// Travel at each of kTableOpenings and its deviation, by the curve's covariance; empty: not
  /// known.
  std::vector<double> duty;
  std::vector<double> duty_deviation;

  [[nodiscard]] OpeningCurve curve() const { return {edge.value, softness.value, exponent.value}; }
};

struct DriveEstimate {
  SideEstimate extend;
  SideEstimate retract;
  Estimate pilot_lag_s;            ///< First-order lag before the spool.
  Estimate spool_time_constant_s;  ///< Each of the spool's two equal lags.
  Estimate stroke_zero_m;          ///< That the sensor shows too much.
  Estimate cap_zero_pa;
  Estimate rod_zero_pa;

  [[nodiscard]] const SideEstimate& side(bool extends) const { return extends ? extend : retract; }
  [[nodiscard]] SideEstimate& side(bool extends) { return extends ? extend : retract; }
  [[nodiscard]] double lag_s() const {
    return pilot_lag_s.value + 2.0 * spool_time_constant_s.value;
  }
};

/// With the swing, which extends to the left: travels at SwingProfile::lever_m, as in the core.
using DriveEstimates = std::array<DriveEstimate, kDriveCount>;

/// The fastest coasting of a side that was seen: from the moment its command was neutral.
struct SwingCoast {
  bool known = false;
  double from_radps = 0.0;  ///< As fast it turned then.
  double angle_rad = 0.0;   ///< So far it went on.
  double time_s = 0.0;
  double most_pa = 0.0;  ///< Largest pressure that braked it; its relief is not below that.
};

/// What a pump that sets its own swash has of its regulator; see PumpRegulator.
struct RegulatorEstimate {
  Estimate margin_pa;   ///< Load sensing.
  Estimate response_s;  ///< Of both.
  // Negative flow.
  Estimate full_swash_pa;
  Estimate least_swash_pa;
  Estimate least_swash_ratio;
};

/// See find_swing().
struct SwingFigures {
  Estimate inertia_kgm2;  ///< Of all that turns, links half out.
  Estimate friction_nm;
  SwingCoast left;
  SwingCoast right;
};

struct MachineEstimate {
  SwingFigures swing;
  DriveEstimates drive;
  std::array<Estimate, kPumpCount> pump_flow_factor;  ///< Of the profile's displacement.
  std::array<RegulatorEstimate, kPumpCount> regulator;
  // With negative flow.
  Estimate bypass_closes_at;         ///< Opening of the profile's model.
  double closes_at_factor = 1.0;     ///< Of the profile's, taken as a share of the travel instead.
  std::vector<std::string> missing;  ///< What the logs do not support, a sentence each.
};

}  // namespace graben::identify
