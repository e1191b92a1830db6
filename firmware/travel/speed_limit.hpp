#pragma once
/// The flow-bounded travel speed (10)-(14) and the acceleration limit (Algorithm 1).

#include "firmware/travel/preview.hpp"

namespace graben {

/// What the speed is chosen from.
struct SpeedDemand {
  double desired_mps = 0.0;          ///< v_d, the operator's share of it.
  double measured_mps = 0.0;         ///< v_v of (10).
  double required_flow_m3ps = 0.0;   ///< Q_in of (7).
  double available_flow_m3ps = 0.0;  ///< min(Q_max,imp, Q_max,valve) of (11).
  double engine_radps = 0.0;
  double heading_radps = 0.0;  ///< omega of (13).
  double blade_angle_rad = 0.0;
  AheadLimit ahead;
};

struct SpeedChoice {
  double speed_mps = 0.0;    ///< v_c of this cycle.
  double allowed_mps = 0.0;  ///< (14) without v_d.
  Limit limit;               ///< What holds v_c below v_d.
};

/// v_c of (14) after the acceleration limit, from that of the last cycle.
///
/// v_max,imp of (11) is not computed while the blade needs no flow, as in the paper, and no speed
/// below v_min is divided by. Every limit is at least v_min, but the operator's own.
///
/// Algorithm 1 keeps the machine from getting faster while the blade is off home, as the body is
/// about to incline. Here the ground ahead is known: it is kept so only where the lowest limit
/// within Preview::kHold_m does not leave room. It brakes at 1.25 times `deceleration_max_mps2` at
/// most: what is ahead is planned with less.
[[nodiscard]] SpeedChoice next_speed(const DozerProfile& profile, double last_mps,
                                     const SpeedDemand& demand, double period_s);

}  // namespace graben
