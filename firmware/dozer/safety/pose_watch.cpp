// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/safety/pose_watch.hpp"

#include <algorithm>
#include <cmath>

namespace graben {
namespace {

/// A residual a cycle on.
void next(double unexplained, double kept, double& residual) {
  residual = kept * (residual + unexplained);
}

/// What of a difference an allowance does not explain.
double beyond(double difference, double allowed) {
  return difference - std::clamp(difference, -allowed, allowed);
}

/// What of the difference to a speed of the tracks is no slip, m/s.
double beyond_slip(double tracks_mps, double ground_mps) {
  return beyond(tracks_mps - ground_mps, kSlipMargin_mps + kPoseMostSlip * std::abs(tracks_mps));
}

/// The least of them.
double least_beyond_slip(const GroundSpeeds& speeds, double ground_mps) {
  double least_mps = beyond_slip(speeds.transmission_mps, ground_mps);
  for (const double tracks_mps : {speeds.left_mps, speeds.right_mps}) {
    const double beyond_mps = beyond_slip(tracks_mps, ground_mps);
    least_mps = std::abs(beyond_mps) < std::abs(least_mps) ? beyond_mps : least_mps;
  }
  return least_mps;
}

/// Slip that a traction explains, as a share of the tracks' speed.
double slip_share(double traction_share) {
  const double loaded = (traction_share - kSlipFromTraction) / kSlipOverTraction;
  return kUnloadedSlip + (kPoseMostSlip - kUnloadedSlip) * std::clamp(loaded, 0.0, 1.0);
}

/// What the body is told to be slower, or faster, than the tracks beyond what their traction
/// explains, summed up over their way from where that begins.
void next_way(const GroundSpeeds& speeds, double ground_mps, double period_s,
              PoseWatchState& state) {
  const double tracks_mps = speeds.way_mps;
  if (!(std::abs(tracks_mps) > kTrackAtRest_mps) || !(speeds.traction_share > 0.0)) {
    return;
  }
  const double slower_mps = std::copysign(1.0, tracks_mps) * (tracks_mps - ground_mps);
  const double may_mps = slip_share(speeds.traction_share) * std::abs(tracks_mps);
  state.behind_m = std::max(0.0, state.behind_m + (slower_mps - may_mps) * period_s);
  state.before_m = std::max(0.0, state.before_m - (slower_mps + may_mps) * period_s);
}

bool exceeds(double residual, double most) { return !(std::abs(residual) <= most); }

}  // namespace

bool watch_pose(const DozerValid& valid, const GroundSpeeds& speeds, double curvature_pm,
                double period_s, PoseWatchState& state) {
  if (!state.has_begun) {
    state = {};
    state.has_begun = true;
  } else {
    const double kept = std::max(0.0, 1.0 - period_s / kPoseForget_s);
    const double kept_long = std::max(0.0, 1.0 - period_s / kDriftForget_s);
    const double tips_mps = kTippingArm_m * std::abs(valid.pitch_rate_radps);
    const double uphill_mps =
        beyond(valid.climb_mps - valid.velocity_mps * std::tan(valid.pitch_rad), tips_mps);
    const double ground_mps = valid.velocity_mps / std::cos(valid.pitch_rad);
    const double ahead_m = valid.position_m - state.position_m - valid.velocity_mps * period_s;
    next(ahead_m, kept, state.ahead_m);
    next(ahead_m, std::max(0.0, 1.0 - period_s / kLaterForget_s), state.later_m);
    next(valid.height_m - state.height_m - valid.climb_mps * period_s, kept, state.climbed_m);
    next(valid.pitch_rad - state.pitch_rad - valid.pitch_rate_radps * period_s, kept,
         state.turned_rad);
    next(valid.roll_rad - state.roll_rad - valid.roll_rate_radps * period_s, kept,
         state.rolled_rad);
    next(valid.pitch_rad - state.pitch_rad - valid.pitch_rate_radps * period_s, kept_long,
         state.nods_rad);
    next(valid.roll_rad - state.roll_rad - valid.roll_rate_radps * period_s, kept_long,
         state.rocks_rad);
    next(valid.course.offset_m - state.offset_m -
             valid.velocity_mps * std::sin(valid.course.heading_rad) * period_s,
         kept, state.aside_m);
    // The velocity is that of the station: the track below the body turns with it.
    const double turns_radps = valid.course.yaw_rate_radps - curvature_pm * valid.velocity_mps;
    next(valid.course.heading_rad - state.heading_rad - turns_radps * period_s, kept,
         state.yawed_rad);
    next(uphill_mps * period_s, std::max(0.0, 1.0 - period_s / kSlopeForget_s), state.uphill_m);
    next(least_beyond_slip(speeds, ground_mps) * period_s, kept, state.slipped_m);
    next_way(speeds, ground_mps, period_s, state);
  }
  state.position_m = valid.position_m;
  state.height_m = valid.height_m;
  state.pitch_rad = valid.pitch_rad;
  state.roll_rad = valid.roll_rad;
  state.offset_m = valid.course.offset_m;
  state.heading_rad = valid.course.heading_rad;
  return exceeds(state.ahead_m, kMostAhead_m) || exceeds(state.climbed_m, kMostClimbed_m) ||
         exceeds(state.turned_rad, kMostTurned_rad) || exceeds(state.rolled_rad, kMostTurned_rad) ||
         exceeds(state.aside_m, kMostAhead_m) || exceeds(state.yawed_rad, kMostYawed_rad) ||
         exceeds(state.uphill_m, kMostUphill_m) || exceeds(state.slipped_m, kMostSlipped_m) ||
         exceeds(state.nods_rad, kMostDrift_rad) || exceeds(state.rocks_rad, kMostDrift_rad) ||
         exceeds(state.later_m, kMostLater_m) || exceeds(state.behind_m, kMostSlips_m) ||
         exceeds(state.before_m, kMostSlips_m);
}

}  // namespace graben
