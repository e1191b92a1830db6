// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Excavators that nobody has described: the plant of a seed, which its controller's profile does
/// not know.

#include <cstdint>

#include "app/machines/simulated/simulated_excavator.hpp"

namespace graben::machines {

/// Where a hidden machine lies; shares are each way, on the nominal figure. Of measured motion of a
/// real excavator (edges 0.40 to 0.55, dead time and lag) and of what sensors and machines of the
/// class have after some years, both widened.
struct HiddenRanges {
  Interval edge_ratio{0.10, 0.55};      ///< Each side of each spool, of its travel.
  Interval softness_ratio{0.02, 0.12};  ///< The same; see SpoolSide.
  Interval opening_exponent{1.3, 1.9};  ///< The same.
  Interval dead_time_s{0.0, 0.250};     ///< Of each drive.
  double dead_time_apart_s = 0.015;     ///< A side's from its drive's, at most, within the above.
  /// Of each drive, whole: twice the spool's time constant (damping 1), which is how late a ramp
  /// comes through it, and the pilot's time constant.
  Interval lag_s{0.015, 0.150};
  Interval spool_lag_share{0.25, 0.75};  ///< Of that, the spool's.
  double area = 0.30;                    ///< Each of the four of each spool.
  double pump_flow = 0.10;
  Interval bulk_modulus_pa{0.7e9, 1.6e9};
  double friction = 0.50;  ///< Coulomb and viscous by themselves, the platform's too.
  double mass = 0.15;      ///< Of each link, and the platform's inertia.
  double stroke_zero_m = 0.010;
  double pressure_zero_pa = 1.2e6;  ///< Each chamber.
  // Of pumps that set their own swash, each by itself.
  double margin = 0.20;
  double response = 0.30;
  double felt_pressure = 0.15;  ///< Each of both.
  double least_swash = 0.20;
  double closes_at = 0.20;  ///< Of all spools alike.
};

/// The nominal machine with the plant of this seed: no figure of the controller's profile changes.
/// Each figure has a stream of its own: one more moves none of the others. The same seed gives the
/// same machine.
[[nodiscard]] SimulatedExcavator hidden_machine(const SimulatedExcavator& nominal,
                                                std::uint64_t seed);

}  // namespace graben::machines
