#pragma once
/// Motion of the body on its springs and dampers: what (15) and (16) will make of the ground ahead.

#include "firmware/dozer/travel/support.hpp"

namespace graben {

/// Of the half-vehicle's mass centre, at one moment; nose up is positive.
struct BodyMotion {
  double centre_m = 0.0;  ///< Height of the mass centre.
  double pitch_rad = 0.0;
  double climb_mps = 0.0;  ///< Of the mass centre.
  double pitch_rate_radps = 0.0;
};

/// The motion in which the body frame's origin has this stand and these rates.
[[nodiscard]] BodyMotion motion_of(const DozerBody& body, const Stand& stand, double climb_mps,
                                   double pitch_rate_radps);
/// Height of the body frame's origin, and pitch.
[[nodiscard]] Stand stand_of(const DozerBody& body, const BodyMotion& motion);
/// Vertical velocity of the body frame's origin.
[[nodiscard]] double origin_climb_mps(const DozerBody& body, const BodyMotion& motion);

/// Longest step that next_motion() stays near the truth with.
inline constexpr double kMotionStep_s = 0.02;
/// So many reach as far as any dead time and latency do.
inline constexpr int kMostMotionSteps = 40;

/// (15), (16) a step on, from where the origin is at `x_m`, driving with `speed_mps`: wheels on springs
/// and dampers that only push, so that a body may tip over a crest and fall behind it. Bounded; a
/// body that is thrown off is caught at what a machine can do.
[[nodiscard]] BodyMotion next_motion(const DozerBody& body, const GroundMap& ground,
                                     const GradeProfile& design, double x_m, double speed_mps,
                                     const BodyMotion& motion, double step_s);

}  // namespace graben
