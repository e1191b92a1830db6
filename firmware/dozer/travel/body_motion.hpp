// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Motion of the body on its springs and dampers: what (15) and (16) will make of the ground ahead,
/// and how it rolls.

#include "firmware/dozer/travel/support.hpp"
#include "firmware/dozer/travel/tuning.hpp"

namespace graben {

/// Of the half-vehicle's mass centre, at one moment; nose up is positive.
struct BodyMotion {
  double centre_m = 0.0;  ///< Height of the mass centre.
  double pitch_rad = 0.0;
  double climb_mps = 0.0;  ///< Of the mass centre.
  double pitch_rate_radps = 0.0;
};

/// Accelerations that the model does not know of: ground that is not what the map says, a load on
/// the blade.
struct BodyBias {
  double climb_mps2 = 0.0;
  double pitch_radps2 = 0.0;
};

/// The motion in which the body frame's origin has this stand and these rates.
[[nodiscard]] BodyMotion motion_of(const DozerBody& body, const Stand& stand, double climb_mps,
                                   double pitch_rate_radps);
/// Height of the body frame's origin, and pitch.
[[nodiscard]] Stand stand_of(const DozerBody& body, const BodyMotion& motion);
/// Vertical velocity of the body frame's origin.
[[nodiscard]] double origin_climb_mps(const DozerBody& body, const BodyMotion& motion);

/// Steps of drive_on(), at most. [-; size: 0.8 s in steps of kMotionStep_s; dead time and pose
/// latency of a profile are 0.7 s at most, and what is longer is done in longer steps]
inline constexpr int kMostMotionSteps = 40;

/// (15), (16) a step on, from where the origin is at `x_m`, driving with `speed_mps`: wheels on
/// springs and dampers that only push, so that a body may tip over a crest and fall behind it.
/// Bounded; a body that is thrown off is caught at what a machine can do.
[[nodiscard]] BodyMotion next_motion(const DozerBody& body, const GroundMap& ground,
                                     const GradeProfile& design, double x_m, double speed_mps,
                                     const BodyMotion& motion, double step_s,
                                     const BodyBias& bias = {});

/// The body and its way.
struct Driving {
  BodyMotion motion;
  double x_m = 0.0;  ///< Of the origin.
  double speed_mps = 0.0;
};

/// The speed that the machine is brought to, and within what time.
struct WantedSpeed {
  double speed_mps = 0.0;
  double within_s = 0.0;
};

/// `lead_s` on, in steps of at most kMotionStep_s; nothing changes within 0.
[[nodiscard]] Driving drive_on(const DozerBody& body, const GroundMap& ground,
                               const GradeProfile& design, const Driving& from,
                               const WantedSpeed& wanted, double lead_s, const BodyBias& bias);

/// State from cycle to cycle of what the model has to be told about itself.
struct Foretelling {
  BodyMotion expected;  ///< What it makes of the last measured motion for this cycle.
  BodyBias bias;        ///< What it did not know of, low-passed.
  bool has_expected = false;
};

/// A cycle on, with what is measured now.
void next_foretelling(const DozerBody& body, const GroundMap& ground, const GradeProfile& design,
                      const Driving& measured, double period_s, Foretelling& state);

/// About the body's longitudinal axis, left side up.
struct BodyRoll {
  double roll_rad = 0.0;
  double rate_radps = 0.0;
};

/// Slope across below the tracks, on the design as already cut, and how it changes along x: the
/// mean over their contact, with the body's origin at `x_m`.
[[nodiscard]] CrossSample cross_below_tracks(const DozerBody& body, const GradeProfile& design,
                                             double x_m);

/// `lead_s` on, from where the origin is at `from_m` to where it is then, driving with `speed_mps`:
/// the springs are stiff against roll, so that it goes on as the ground below the tracks does. What
/// the measured rate has more than that is rocking, which dies away.
[[nodiscard]] BodyRoll roll_after(const DozerBody& body, const GradeProfile& design,
                                  const BodyRoll& measured, double from_m, double to_m,
                                  double speed_mps, double lead_s);

}  // namespace graben
