// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Guards tracks whose transmission is not known: displacements are tried on both of them alike,
/// open loop, within a way to each side of where the machine stood. Beside it the watches of
/// displacements, tracks and pose go on.

#include <array>

#include "firmware/dozer/safety/dozer_validation.hpp"

namespace graben {

/// State from cycle to cycle.
struct TravelGuardState {
  bool begun = false;            ///< `from_m` is set.
  double from_m = 0.0;           ///< Position at which they were tried first.
  double speed_mps = 0.0;        ///< Low-passed, forward is positive.
  double since_forward_s = 0.0;  ///< Since the last displacement forwards; as long as it matters.
  double since_back_s = 0.0;
  double wrong_m = 0.0;   ///< Gone against what is under way.
  double free_m = 0.0;    ///< Gone although nothing is.
  double stands_s = 0.0;  ///< Stood though it is told to go.
  int held_side = 0;      ///< To which the window holds it back.
  bool moves = false;     ///< Displacements were tried in the last cycle, or are under way.
};

/// What is tried in this cycle.
struct TravelAsk {
  double sent_ratio = 0.0;    ///< Pumps' displacement of the last cycle.
  double wanted_ratio = 0.0;  ///< What is asked for now.
  StrokeWindow window;        ///< m behind and before `from_m`; as constructed: none is confirmed.
};

struct TravelGuardResult {
  Fault fault = Fault::kNone;
  double pump_ratio = 0.0;  ///< What may be sent.
  bool held = false;        ///< 0 because of the window.
};

/// The window is one that lets the machine go to both sides, by no more than kTravelMostWay_m.
[[nodiscard]] bool is_travel_window(const StrokeWindow& window);

/// A cycle on. Without a window the displacement is 0. Where the machine is outside, or will be
/// before it can be stopped, it is 0 towards there until that is no longer asked for.
///
/// kCommissionBound: outside by more than kTravelOutside_m, or faster than the window allows.
/// kWrongDirection: gone by kTravelWrong_m against all that is under way. kUncommandedMotion: gone
/// as far although nothing is. kStalled: stands for kTravelStands_s at displacements that move any
/// machine.
[[nodiscard]] TravelGuardResult next_travel(const TravelAsk& ask, const DozerValid& seen,
                                            double period_s, TravelGuardState& state);

/// The same while nothing is tried. `forgets`: the machine went elsewhere by other means, and what
/// is tried next begins where it then stands.
void rest_travel(bool forgets, TravelGuardState& state);

}  // namespace graben
