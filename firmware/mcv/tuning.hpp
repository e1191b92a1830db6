// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Numbers that were chosen for the valve's circuit and its optimiser, each with why.

namespace graben {

// Lines without pump flow (circuit.cpp, descent.cpp)

/// Share of what a line's cylinders move below which its pump flow counts as none in searches over
/// r. [-; chosen: less is all rounding there, and the exact circuit decides in the end; not tried]
inline constexpr double kStarvedFlowShare = 1e-9;
/// Factor on r of a stagnant line that puts it left of where 1 / lambda becomes infinite. [-;
/// chosen: well beyond rounding; not tried]
inline constexpr double kStagnantInside = 1.0 - 1e-9;

// Newton's guesses (pump_pressure.cpp, pressure_ratio.cpp)

/// First step of the pressure's Newton, as a share of its guess, from which the guess was too far
/// off. [-; chosen: few steps are left for it; not tried]
inline constexpr double kPressureGuessFar = 0.25;
/// First step of 1 / lambda's Newton, as a share of it, from which the guess was too far off. [-;
/// chosen: the guess says less than the leakage does; not tried]
inline constexpr double kRatioGuessFar = 0.25;

// Search for a requirement's change (requirement.cpp)

/// Share of lambda below which Newton's next step is the last one. [-; chosen: its error, about the
/// square, is far below the 1e-9 of choose_global(); not tried]
inline constexpr double kLastNewtonShare = 1e-7;
/// Share of lambda below which a chord's step is the last one. [-; chosen: it ends inside Newton's,
/// whose error is about the square, 1e-10; not tried]
inline constexpr double kLastChordShare = 1e-5;
/// Factor on 1 / lambda that a search's first chord spans. [-; chosen: a longer one says next to
/// nothing where lambda goes to 0 at a finite r; not tried]
inline constexpr double kFirstChordSpan = 4.0;
/// Share of drive and resistance together below which their difference is rounding. [-; chosen:
/// some 50 roundings; not tried]
inline constexpr double kGapRoundingShare = 1e-14;

// Optimiser (optimiser.cpp)

/// Steps that a solve's search over r takes at most, all of its parts together; then it halves. [-;
/// size: for the largest lambda 2.4 million random circuits take 527 at most, with halving, and all
/// but a ten thousandth 287; for the end of the connected interval 929 in 200 000 without a cap]
inline constexpr int kSearchSteps = 480;
/// Steps beside them that halving takes at most. [-; size: Algorithm 1 takes 286 at most on 400 000
/// of them]
inline constexpr int kHalvingSteps = 320;
/// Steps that a solve has at least, whatever earlier ones of its cycle took. [-; size: of 2.4
/// million random circuits all but a ten thousandth take 287 with those for halving; a second solve
/// has as many unless the first was one of the others]
inline constexpr int kLeastSteps = 240;
/// Steps of them that are kept for what is told of a choice, where pumps set their own swash. [-;
/// size: two pumps, each a pressure of three parts and a bypass that settles: 90 at most in 3 000
/// cycles of the shipped machines]
inline constexpr int kRegulatedToldSteps = 120;
/// Steps of these for the bypasses alone. [-; derived: 24 halvings for each of two pumps]
inline constexpr int kBypassSteps = 48;

/// Actuators of a small circuit at most: one by the policy for the largest lambda, whose pumps
/// regulate nothing. [-; derived: as many as the shipped machines have]
inline constexpr int kSmallActuators = 4;
/// Pumps of it at most. [-; derived: as many as the shipped machines have]
inline constexpr int kSmallPumps = 2;
/// Its kSearchSteps. [-; size: both solves of a fuzzed cycle take 120 together; any inputs of the
/// shipped valves 300 at most in 120 000, all but a thousandth 204]
inline constexpr int kSmallSearchSteps = 200;
/// Its kHalvingSteps. [-; size: Algorithm 1 takes 193 at most there]
inline constexpr int kSmallHalvingSteps = 200;
/// Its kLeastSteps. [-; size: as many as both solves of a fuzzed cycle take together]
inline constexpr int kSmallLeastSteps = 120;

/// Multiple of a spool table's last c_L and travel beyond which a shortfall is not told apart. [-;
/// chosen: not tried]
inline constexpr double kShortfallMost = 16.0;
/// Greatest share of an axis' force at standstill, (43), that the reserve takes. [-; chosen: an
/// axis that can hardly start still starts, and others keep their reserve; not tried]
inline constexpr double kMostReserveShare = 0.5;
/// Lambda that the first cycle from rest may reach, whatever its period. [-; chosen: not tried]
inline constexpr double kFirstLambda = 1e-3;

}  // namespace graben
