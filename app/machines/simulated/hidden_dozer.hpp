// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Dozers that nobody has described: the plant of a seed, which its controller's profile does not
/// know.

#include <cstdint>

#include "app/machines/simulated/simulated_dozer.hpp"

namespace graben::machines {

/// Where a hidden dozer lies; shares are each way, on the nominal figure. Valves as the hidden
/// excavators', with edges and lags of valves that are made for a blade.
struct HiddenDozerRanges {
  double edge_least = 0.10;  ///< Each side of each spool, of its travel.
  double edge_most = 0.35;
  double softness_least = 0.02;
  double softness_most = 0.08;
  double exponent_least = 1.0;  ///< Of flow over the way out of the dead band.
  double exponent_most = 1.4;
  double dead_time_most_s = 0.080;  ///< Of each drive.
  double dead_time_apart_s = 0.010;
  double lag_least_s = 0.015;  ///< Pilot and twice the spool's time constant.
  double lag_most_s = 0.080;
  double valve_flow = 0.15;
  double pump_flow = 0.08;  ///< Of the implement's pump, at most its displacement.
  double bulk_modulus_least_pa = 0.8e9;
  double bulk_modulus_most_pa = 1.6e9;
  double friction = 0.50;  ///< Coulomb and viscous, of the blade's cylinders.
  double mass = 0.10;
  double piston_leak_least = 0.3;  ///< Of the nominal leakage past a piston.
  double piston_leak_most = 5.0;
  double track_flow = 0.05;    ///< Of both paths alike.
  double track_apart = 0.015;  ///< One path's from that.
  double servo_lag = 0.50;     ///< Of pumps and motors.
  double servo_dead_time_most_s = 0.040;
  double rolling = 0.30;
  double gauge = 0.03;
};

/// The nominal machine with the plant of this seed, with sensors' noise: no figure of the
/// controller's profile changes. Each figure has a stream of its own. The same seed gives the same
/// machine.
[[nodiscard]] SimulatedDozer hidden_dozer(const SimulatedDozer& nominal, std::uint64_t seed);

}  // namespace graben::machines
