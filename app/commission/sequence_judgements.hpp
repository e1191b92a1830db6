// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Judgements of CommissionSequence: duties as shares of the spool's travel, levels as shares of
/// what is left beyond the edge.

#include <array>

#include "app/commission/commission_plan.hpp"

namespace graben::commission {

inline constexpr double kPeriod_s = 0.01;
/// Of a ramp. Slow: what a late machine is ahead of itself by then is a tenth of its edge.
inline constexpr double kRampFrom = 0.04;
inline constexpr double kRampSteep = 0.20;  ///< 1/s, up to the least edge that is likely.
inline constexpr double kRampSlow = 0.08;   ///< 1/s
inline constexpr double kRampTo = 0.80;
/// By which it may be before what was sent: some cycles of it.
inline constexpr double kAhead = 0.02;
inline constexpr double kLeastEdge = 0.08;
/// It moves, and has moved: a linkage that rocks comes back.
inline constexpr double kMoves_mps = 0.010;
inline constexpr double kMoved_m = 0.006;
inline constexpr double kMovesFor_s = 0.25;
/// A ramp goes on a little beyond: the curve's foot.
inline constexpr double kFoot_s = 0.45;
/// Of what is left of the duty beyond the edge.
inline constexpr std::array<double, kLevelCount> kLevels = {0.08, 0.18, 0.35, 0.62, 1.0};
inline constexpr double kPairLevel = 0.55;
inline constexpr double kBurstLevel = 0.30;
inline constexpr double kFirstLevel = 0.15;  ///< Untried, no more of it than this.
/// Two drives at once are left out after so long where a swing is still to come.
inline constexpr double kPairsUntil_s = 225.0;
/// From place to place, near to it, and onto an end.
inline constexpr double kTravel_mps = 0.14;
/// The same where a swing is to be led as well: five minutes are for all.
inline constexpr double kTravelWithSwing_mps = 0.22;
inline constexpr double kNear_mps = 0.05;
inline constexpr double kNear_m = 0.10;
inline constexpr double kLast_mps = 0.025;
inline constexpr double kLast_m = 0.03;
inline constexpr double kLetGo_s = 0.2;
/// A piston that has stood for so long is pushed a little more.
inline constexpr double kPresses_s = 0.2;
/// As much more of the level a second where it stands before its end, and less where it is so many
/// times as fast as it should be.
inline constexpr double kPushes_ps = 0.4;
inline constexpr double kTooFast = 1.5;
/// The same in its cushion, where it is slower than such a share of what it should be.
inline constexpr double kPushesLast_ps = 0.05;
inline constexpr double kCreeps = 0.3;
/// A step lasts so long after its drive has begun to move.
inline constexpr double kHold_s = 0.75;
inline constexpr double kNoMotion_s = 1.4;
/// A drive that its load pushes back so far is let go.
inline constexpr double kBack_m = 0.006;
/// What a machine may need to stop: dead time and lags.
inline constexpr double kStops_s = 0.50;
inline constexpr double kMargin_m = 0.03;
/// Between two steps: standing, and everything under way has come.
inline constexpr double kRest_s = 0.45;
inline constexpr double kRestMost_s = 2.0;
inline constexpr double kStands_mps = 0.003;
inline constexpr double kStandsFor_s = 0.25;
/// Speed grows with the level no faster than with this power.
inline constexpr double kSteepest = 2.0;
inline constexpr double kOfMost = 0.75;
inline constexpr double kPress_s = 0.80;
inline constexpr double kSame_m = 0.00015;
inline constexpr double kPulse_s = 0.15;
inline constexpr int kPulses = 4;
inline constexpr double kThere_m = 0.03;

}  // namespace graben::commission
