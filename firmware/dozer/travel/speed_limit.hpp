// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The flow-bounded travel speed (10)-(14) and the acceleration limit (Algorithm 1).

#include "firmware/dozer/travel/preview.hpp"

namespace graben {

/// Inputs of the choice of speed.
struct SpeedDemand {
  double desired_mps = 0.0;          ///< v_d, the operator's share of it.
  double measured_mps = 0.0;         ///< v_v of (10).
  double required_flow_m3ps = 0.0;   ///< Q_in of (7).
  double available_flow_m3ps = 0.0;  ///< min(Q_max,imp, Q_max,valve) of (11).
  double engine_radps = 0.0;
  double heading_radps = 0.0;  ///< omega of (13).
  double blade_angle_rad = 0.0;
  double off_m = 0.0;  ///< The cutting edge above where it is meant to be.
  AheadLimit ahead;
};

/// State from cycle to cycle.
struct SpeedState {
  double speed_mps = 0.0;           ///< v_c
  double required_flow_m3ps = 0.0;  ///< Q_in, low-passed.
  double off_grade_m = 0.0;         ///< The size of the edge's error, low-passed.
  bool rising = false;
  double since_fall_s = 1.0;  ///< Since v_c last fell.
};

struct SpeedChoice {
  double allowed_mps = 0.0;  ///< (14) without v_d.
  Limit limit;               ///< What holds v_c below v_d.
  SpeedState state;
};

/// v_c of (14) after the acceleration limit, from that of the last cycle.
///
/// Beyond the paper it slows down while the edge is more than kSpeedOnGrade of what is allowed off
/// where it is meant to be, to v_min at kSpeedOffGrade of it: so it begins with the blade on the
/// grade, and what went wrong is mended on the spot.
///
/// v_max,imp of (11) is not computed while the blade needs no flow, as in the paper, and no speed
/// below v_min is divided by. Every limit is at least v_min, but the operator's own.
///
/// Algorithm 1 keeps the machine from getting faster while the blade is off home, as the body is
/// about to incline. Here the ground ahead is known: off home it rises no higher than the lowest
/// limit on the way of kPreviewHold_s, and begins to rise only where that is worth it and some
/// time after it fell; so a wanted speed does not run up and down with every limit that it passes.
/// It brakes at kSpeedBraking times `deceleration_max_mps2` at most: what is ahead is planned with
/// less.
[[nodiscard]] SpeedChoice next_speed(const DozerProfile& profile, const SpeedState& last,
                                     const SpeedDemand& demand, double period_s);

}  // namespace graben
