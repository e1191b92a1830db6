// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/travel/body_motion.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/dozer/travel/tuning.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben {
namespace {

struct Load {
  double force_n = 0.0;
  double moment_nm = 0.0;
  double damping_nspm = 0.0;  ///< Of what is pressed: against climbing, and against pitching.
  double damping_nmsprad = 0.0;
};

/// What the ground does to the body about its mass centre.
Load load_of(const DozerBody& body, const GroundMap& ground, const GradeProfile& design, double x_m,
             double speed_mps, const BodyMotion& motion) {
  const double sag_m = body.mass_kg * kStandardGravity_mps2 / (body.wheels * body.suspension_npm);
  const double depth_m = body.mass_centre_height_m + sag_m;
  const double c = std::cos(motion.pitch_rad);
  const double s = std::sin(motion.pitch_rad);
  const double spacing_m = body.track_contact_m / (body.wheels - 1);
  double along_m = -0.5 * body.track_contact_m;
  Load load;
  for (int i = 0; i < body.wheels; ++i, along_m += spacing_m) {
    const double wheel_x_m = x_m + along_m * c + sag_m * s;
    const double behind_m = ground.height_m(wheel_x_m - kHalfWheel_m, design);
    const double ahead_m = ground.height_m(wheel_x_m + kHalfWheel_m, design);
    const double lever_m = along_m * c + depth_m * s;
    const double pressed_m =
        0.5 * (behind_m + ahead_m) - (motion.centre_m + along_m * s - depth_m * c);
    if (pressed_m > 0.0) {
      const double forward_mps = speed_mps - motion.pitch_rate_radps * (along_m * s - sag_m * c);
      const double rate_mps = (ahead_m - behind_m) / (2.0 * kHalfWheel_m) * forward_mps -
                              (motion.climb_mps + motion.pitch_rate_radps * lever_m);
      const double force_n =
          std::max(0.0, body.suspension_npm * pressed_m + body.suspension_nspm * rate_mps);
      load.force_n += force_n;
      load.moment_nm += force_n * lever_m;
      if (force_n > 0.0) {
        load.damping_nspm += body.suspension_nspm;
        load.damping_nmsprad += body.suspension_nspm * lever_m * lever_m;
      }
    }
  }
  return load;
}

}  // namespace

BodyMotion motion_of(const DozerBody& body, const Stand& stand, double climb_mps,
                     double pitch_rate_radps) {
  const double high_m = body.mass_centre_height_m;
  return {stand.height_m + high_m * std::cos(stand.pitch_rad), stand.pitch_rad,
          climb_mps - high_m * std::sin(stand.pitch_rad) * pitch_rate_radps, pitch_rate_radps};
}

Stand stand_of(const DozerBody& body, const BodyMotion& motion) {
  return {motion.centre_m - body.mass_centre_height_m * std::cos(motion.pitch_rad),
          motion.pitch_rad};
}

double origin_climb_mps(const DozerBody& body, const BodyMotion& motion) {
  return motion.climb_mps +
         body.mass_centre_height_m * std::sin(motion.pitch_rad) * motion.pitch_rate_radps;
}

BodyMotion next_motion(const DozerBody& body, const GroundMap& ground, const GradeProfile& design,
                       double x_m, double speed_mps, const BodyMotion& motion, double step_s,
                       const BodyBias& bias) {
  // Half the way, the forces there, the other half with what they made of the velocity: second
  // order for one look at the ground. Damping counts with the mean of old and new velocity.
  const double half_s = 0.5 * step_s;
  BodyMotion next = motion;
  next.centre_m += half_s * motion.climb_mps;
  next.pitch_rad += half_s * motion.pitch_rate_radps;
  const Load load = load_of(body, ground, design, x_m + half_s * speed_mps, speed_mps, next);
  const double climbing_mps2 = (load.force_n - body.mass_kg * kStandardGravity_mps2) /
                               (body.mass_kg + half_s * load.damping_nspm);
  const double pitching_radps2 =
      load.moment_nm / (body.pitch_inertia_kgm2 + half_s * load.damping_nmsprad);
  next.climb_mps = std::clamp(motion.climb_mps + step_s * (climbing_mps2 + bias.climb_mps2),
                              -kModelMostClimb_mps, kModelMostClimb_mps);
  next.pitch_rate_radps =
      std::clamp(motion.pitch_rate_radps + step_s * (pitching_radps2 + bias.pitch_radps2),
                 -kModelMostRate_radps, kModelMostRate_radps);
  next.centre_m += half_s * next.climb_mps;
  next.pitch_rad = std::clamp(next.pitch_rad + half_s * next.pitch_rate_radps, -kModelMostPitch_rad,
                              kModelMostPitch_rad);
  return next;
}

Driving drive_on(const DozerBody& body, const GroundMap& ground, const GradeProfile& design,
                 const Driving& from, const WantedSpeed& wanted, double lead_s,
                 const BodyBias& bias) {
  const int steps =
      std::clamp(static_cast<int>(std::ceil(lead_s / kMotionStep_s)), 0, kMostMotionSteps);
  const double step_s = steps > 0 ? lead_s / steps : 0.0;
  const double gaining_mps2 = (wanted.speed_mps - from.speed_mps) / wanted.within_s;
  Driving driving = from;
  for (int n = 0; n < steps; ++n) {
    driving.speed_mps += gaining_mps2 * step_s;
    driving.motion = next_motion(body, ground, design, driving.x_m, driving.speed_mps,
                                 driving.motion, step_s, bias);
    driving.x_m += driving.speed_mps * step_s;
  }
  return driving;
}

void next_foretelling(const DozerBody& body, const GroundMap& ground, const GradeProfile& design,
                      const Driving& measured, double period_s, Foretelling& state) {
  BodyBias& bias = state.bias;
  if (!state.has_expected) {
    bias = {};
  } else if (period_s > 0.0) {
    const double newest_ps = 1.0 / (period_s + kModelBias_s);
    const double climb_mps = measured.motion.climb_mps - state.expected.climb_mps;
    const double pitch_radps = measured.motion.pitch_rate_radps - state.expected.pitch_rate_radps;
    bias.climb_mps2 = std::clamp(bias.climb_mps2 + newest_ps * climb_mps, -kModelMostBias_mps2,
                                 kModelMostBias_mps2);
    bias.pitch_radps2 = std::clamp(bias.pitch_radps2 + newest_ps * pitch_radps,
                                   -kModelMostBias_radps2, kModelMostBias_radps2);
  }
  state.expected = next_motion(body, ground, design, measured.x_m, measured.speed_mps,
                               measured.motion, period_s, bias);
  state.has_expected = true;
}

CrossSample cross_below_tracks(const DozerBody& body, const GradeProfile& design, double x_m) {
  // Gauss's two points of the contact.
  const double off_m = 0.5 * body.track_contact_m * 0.57735026918962576;
  const CrossSample behind = design.cross_at(x_m - off_m);
  const CrossSample ahead = design.cross_at(x_m + off_m);
  return {0.5 * (behind.slope + ahead.slope), 0.5 * (behind.change_pm + ahead.change_pm)};
}

BodyRoll roll_after(const DozerBody& body, const GradeProfile& design, const BodyRoll& measured,
                    double from_m, double to_m, double speed_mps, double lead_s) {
  const CrossSample from = cross_below_tracks(body, design, from_m);
  const CrossSample to = cross_below_tracks(body, design, to_m);
  const double rocking_radps = measured.rate_radps - from.change_pm * speed_mps;
  const double kept = std::exp(-std::max(0.0, lead_s) / kRollRocking_s);
  return {measured.roll_rad + to.slope - from.slope + rocking_radps * kRollRocking_s * (1.0 - kept),
          to.change_pm * speed_mps + rocking_radps * kept};
}

}  // namespace graben
