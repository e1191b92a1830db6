// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Fourth stage of a cycle: what ends, fences, blocked drives and the pumps' flow leave of a
/// motion.

#include "firmware/drives/spool_parking.hpp"
#include "firmware/excavator/motion/motion.hpp"
#include "firmware/mcv/optimiser.hpp"

namespace graben {

/// State from cycle to cycle.
struct LimitState {
  std::array<ParkingState, 2> parking;  ///< Of boom and arm.
};

/// What the pumps' flow leaves of a motion. The path alone decides how fast it is followed, with
/// the reserve: corrections change sign from cycle to cycle. What they then ask for beyond the
/// flow slows both.
struct Followed {
  McvSolution solution;       ///< Of the motion with its corrections.
  double lambda = 0.0;        ///< Of the motion without them.
  double of_corrected = 0.0;  ///< Share of that, with them.

  bool as_wanted = false;  ///< Without corrections: they would have held up a move.
  bool eases = false;      ///< Of the motion; then the path has no share in it.

  /// Of the corrected motion.
  [[nodiscard]] double all() const { return (eases ? 1.0 : lambda) * of_corrected; }
  /// Of the path.
  [[nodiscard]] double of_way() const { return eases ? 0.0 : lambda * of_corrected; }
};

/// What the valve is asked for; where no pressures are measured, at the worst loads.
[[nodiscard]] McvInput valve_input(const ExcavatorModel& machine, const DriveVector& wanted_mps,
                                   const ExcavatorValid& valid, const EstimationState& estimates);

/// Slows `motion` before ends and fences, beyond a fence to what leads back; asks no more of a
/// drive that its load holds than path or plan want; holds all where somebody outside stops; lets
/// boom and arm stand where their corrections would reverse them for little. Not inlined, for the
/// stack below the solver.
[[gnu::noinline]] void hold_back(const ExcavatorModel& machine, const ExcavatorValid& valid,
                                 const InputState& inputs, const EstimationState& estimates,
                                 double period_s, const LastCycle& last, Motion& motion,
                                 LimitState& state);

/// Factor on control.lambda_rise_reserve that this motion wants.
[[nodiscard]] double reserve_ratio(const Motion& motion);

/// How fast that may be followed, by the pumps' flow.
[[nodiscard]] Followed flow_limited(const ExcavatorModel& machine, const ExcavatorValid& valid,
                                    const EstimationState& estimates, const Motion& motion,
                                    double period_s, const LastCycle& last);

}  // namespace graben
