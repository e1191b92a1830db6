// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Passes: what the blade had to leave above the design is gone back for, until the design is met.

#include <cstdint>

#include "firmware/dozer/grade_profile.hpp"

namespace graben {

enum class PassPhase : std::uint8_t {
  kCut,     ///< Forward, on the design.
  kStop,    ///< At the pass's end: to a halt, the blade rising.
  kReturn,  ///< Backward, the blade clear of the ground.
  kTurn,    ///< To a halt before what is left, the blade coming down as it goes on.
};

/// State from cycle to cycle.
struct PassState {
  PassPhase phase = PassPhase::kCut;
  int pass = 1;
  double depth_m = 0.0;    ///< So deep below the ground this pass may cut; 0: the first.
  double step_m = 0.0;     ///< Deeper than the one before; 0: the first.
  double most_push = 0.0;  ///< In this pass, of what the tracks may push.
  double lifted_m2 = 0.0;  ///< By which its load has lifted the blade, over its way.
  double way_m = 0.0;
  double error_m = 0.0;  ///< Of the edge over the design, low-passed: a pass is not for noise.
  bool left = false;     ///< Something was left in this pass, from this place of the edge on.
  double from_m = 0.0;
  double left_m2 = 0.0;       ///< What stands above the tolerance there, in this pass,
  double last_left_m2 = 0.0;  ///< and in the one before; 0: the first.
  int vain = 0;               ///< Passes in a row that have lowered nothing.
  bool down = true;           ///< The blade has come to the ground in this pass,
  double due_m = 0.0;         ///< which it is to from here on: what the pass before left.
  double clear_m = 0.0;       ///< The blade over the design.
  double clear_mps = 0.0;
  bool finished = false;  ///< The last pass has left nothing, or there may be no more.
};

/// Where the machine is in it.
struct PassSituation {
  double edge_x_m = 0.0;
  double error_m = 0.0;  ///< Of the edge over the design.
  double velocity_mps = 0.0;
  double push = 0.0;    ///< Of the tracks, of what they may push.
  double lift_m = 0.0;  ///< Of the blade by its load.
};

/// A cycle on. In a pass, what the edge leaves clearly more than the tolerance above the design is
/// noted with its place, but for where the blade is still on its way down. At the design's last
/// point, behind which what it carries is dumped, the machine stops and goes back with the blade
/// clear of the ground, to a run-up before the first of it; and cuts again, up to `passes_most`
/// times, as long as one of two passes lowers what the one before has left.
///
/// The first pass goes `pass_depth_m` deep; each next one as much deeper as the one before had
/// force to spare, or less where its load lifted the blade.
[[nodiscard]] PassState next_pass(const GradeDesign& design, const PassState& last,
                                  const PassSituation& now, double period_s);

/// Lowest that this pass may cut, over the design's plane.
[[nodiscard]] double pass_floor_m(const GradeDesign& design, const PassState& state);

/// Speed that a phase other than kCut drives with: backward, slower near where it turns; or none.
[[nodiscard]] double pass_speed_mps(const PassState& state, const PassSituation& now,
                                    double desired_mps, double deceleration_mps2);

}  // namespace graben
