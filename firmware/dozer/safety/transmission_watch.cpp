// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/safety/transmission_watch.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/dozer/safety/tuning.hpp"
#include "firmware/dozer/travel/blade_load.hpp"
#include "firmware/dozer/travel/tracks.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben {
namespace {

/// Takes in what one displacement's watch says.
void take(const DisplacementResult& result, FaultSet& stops) {
  if (result.disagrees) {
    stops.add(Fault::kDisplacementDisagrees);
  }
  if (result.runs_away) {
    stops.add(Fault::kDisplacementRunaway);
  }
}

bool differs(double a_mps, double b_mps, double margin_mps, double share) {
  return std::abs(a_mps - b_mps) > margin_mps + share * std::abs(b_mps);
}

/// What the sensors are compared with.
struct TrackSpeeds {
  std::array<double, kTrackCount> expected_mps{};  ///< (9)
  double body_mps = 0.0;                           ///< Along the ground.
  std::array<double, kTrackCount> beside_mps{};    ///< The same below each track.
};

TrackSpeeds speeds_beside(const DozerProfile& profile, const DozerValid& valid) {
  TrackSpeeds speeds;
  for (unsigned i = 0; i < kTrackCount; ++i) {
    speeds.expected_mps[i] =
        track_speed_mps(profile.hst, valid.engine_radps, valid.pump_ratio[i], valid.motor_ratio[i]);
  }
  // Validation has refused a pitch near to upright.
  speeds.body_mps = valid.velocity_mps / std::cos(valid.pitch_rad);
  speeds.beside_mps = track_speeds_mps(profile.body, speeds.body_mps, valid.course.yaw_rate_radps);
  return speeds;
}

bool is_outvoted(const TrackSpeeds& speeds, const DozerValid& valid, unsigned track) {
  const double measured_mps = valid.track_speed_mps[track];
  return differs(measured_mps, speeds.expected_mps[track], kTrackVoteMargin_mps, kTrackLossShare) &&
         differs(measured_mps, speeds.beside_mps[track], kTrackVoteMargin_mps, kTrackSlipShare);
}

bool are_apart(const DozerProfile& profile, const TrackSpeeds& speeds, const DozerValid& valid) {
  const double share = profile.grade.curves() ? kTracksApartOnCurve : kTracksApartShare;
  const double left_mps = valid.track_speed_mps[kLeft] - speeds.expected_mps[kLeft];
  const double right_mps = valid.track_speed_mps[kRight] - speeds.expected_mps[kRight];
  return std::abs(left_mps - right_mps) >
         kTracksApartMargin_mps + share * std::abs(speeds.body_mps);
}

/// The time that something has lasted.
void count(bool lasts, double period_s, double& for_s) { for_s = lasts ? for_s + period_s : 0.0; }

/// With neither track, the body goes otherwise than it does itself, slip taken off.
bool goes_along(const TrackSpeeds& speeds, const DozerValid& valid) {
  bool along = true;
  for (unsigned i = 0; i < kTrackCount; ++i) {
    const double track_mps = valid.track_speed_mps[i];
    along = along && !differs(speeds.beside_mps[i], track_mps, kSlipMargin_mps, kPoseMostSlip);
  }
  return along;
}

/// More than the slope takes: a load holds the tracks.
bool presses(const DozerProfile& profile, const DozerValid& valid) {
  const double weight_n = profile.body.mass_kg * kStandardGravity_mps2;
  const double slope_n = weight_n * std::abs(std::sin(valid.pitch_rad));
  return traction_n(profile, valid) > slope_n + kTrackPressShare * weight_n;
}

bool stand(const TrackSpeeds& speeds, const DozerValid& valid) {
  bool all = true;
  for (unsigned i = 0; i < kTrackCount; ++i) {
    const double expected_mps = std::abs(speeds.expected_mps[i]);
    const double along_mps = std::copysign(1.0, speeds.expected_mps[i]) * valid.track_speed_mps[i];
    all =
        all && expected_mps > kTrackStandsFrom_mps && along_mps < kTrackStandsShare * expected_mps;
  }
  return all;
}

/// Both, to the same side, for so long that each disagrees.
bool are_off(const TrackSpeeds& speeds, const DozerValid& valid,
             const TransmissionWatchState& state) {
  const double left_mps = valid.track_speed_mps[kLeft] - speeds.expected_mps[kLeft];
  const double right_mps = valid.track_speed_mps[kRight] - speeds.expected_mps[kRight];
  return std::min(state.track_off_s[kLeft], state.track_off_s[kRight]) > kTrackOff_s &&
         left_mps * right_mps > 0.0;
}

/// Or as fast, the other way.
bool are_faster(const TrackSpeeds& speeds, const DozerValid& valid) {
  double more_mps = 0.0;
  for (unsigned i = 0; i < kTrackCount; ++i) {
    more_mps += std::abs(valid.track_speed_mps[i]) - std::abs(speeds.expected_mps[i]);
  }
  return more_mps >= 0.0;
}

/// What stops, where tracks and body agree against (9). After watch_tracks().
void watch_both(const DozerProfile& profile, const DozerValid& valid, double period_s,
                TransmissionWatchState& state, FaultSet& stops) {
  const TrackSpeeds speeds = speeds_beside(profile, valid);
  const bool along = goes_along(speeds, valid);
  count(along && !presses(profile, valid) && stand(speeds, valid), period_s, state.stood_s);
  if (state.stood_s > kTrackStands_s) {
    stops.add(Fault::kEngineDoubtful);
  }
  if (along && are_off(speeds, valid, state) && are_faster(speeds, valid)) {
    stops.add(Fault::kTracksAstray);
    stops.add(Fault::kDisplacementRunaway);
  }
}

/// True where a track's sensor disagrees.
bool watch_tracks(const DozerProfile& profile, double period_s, TransmissionWatchState& state,
                  DozerValid& valid) {
  const TrackSpeeds speeds = speeds_beside(profile, valid);
  count(are_apart(profile, speeds, valid), period_s, state.apart_s);
  bool disagree = state.apart_s > kTracksApart_s;
  for (unsigned i = 0; i < kTrackCount; ++i) {
    valid.track_outvoted[i] = is_outvoted(speeds, valid, i);
    count(valid.track_outvoted[i], period_s, state.outvoted_s[i]);
    count(differs(valid.track_speed_mps[i], speeds.expected_mps[i],
                  profile.safety.track_speed_tolerance_mps, kTrackLossShare),
          period_s, state.track_off_s[i]);
    disagree =
        disagree || state.outvoted_s[i] > kTrackOutvoted_s || state.track_off_s[i] > kTrackOff_s;
  }
  return disagree;
}

}  // namespace

TransmissionWatchResult watch_transmission(const DozerProfile& profile,
                                           TransmissionWatchState& state, const SentRatios& sent,
                                           DisplacementTask task, DozerValid& valid,
                                           double period_s) {
  const DisplacementLimits limits{profile.safety.displacement_tolerance,
                                  profile.safety.displacement_settle_s};
  const bool tracks_judged =
      task == DisplacementTask::kFollow && !valid.faults.has(Fault::kEngineSpeedMissing);
  TransmissionWatchResult result;
  for (unsigned i = 0; i < kTrackCount; ++i) {
    take(watch_displacement(limits, state.pump[i], sent.pump[i], task, valid.pump_ratio[i],
                            period_s),
         result.stops);
    take(watch_displacement(limits, state.motor[i], sent.motor[i], task, valid.motor_ratio[i],
                            period_s),
         result.stops);
  }
  if (tracks_judged) {
    result.tracks_disagree = watch_tracks(profile, period_s, state, valid);
    watch_both(profile, valid, period_s, state, result.stops);
  } else {
    state.track_off_s = {};
    state.outvoted_s = {};
    state.apart_s = 0.0;
    state.stood_s = 0.0;
  }
  return result;
}

GroundSpeeds ground_speeds(const DozerProfile& profile, const DozerValid& valid) {
  const TrackSpeeds speeds = speeds_beside(profile, valid);
  std::array<double, kTrackCount> way_mps = valid.track_speed_mps;
  const bool known = !valid.faults.has(Fault::kEngineSpeedMissing);
  for (unsigned i = 0; i < kTrackCount; ++i) {
    if (known && valid.track_outvoted[i]) {
      way_mps[i] = speeds.expected_mps[i];
    }
  }
  const std::array<double, kTrackCount>& tracks_mps = valid.track_speed_mps;
  const bool left =
      std::abs(way_mps[kLeft] - speeds.body_mps) < std::abs(way_mps[kRight] - speeds.body_mps);
  return {
      tracks_mps[kLeft], tracks_mps[kRight],
      known ? 0.5 * (speeds.expected_mps[kLeft] + speeds.expected_mps[kRight]) : tracks_mps[kLeft],
      way_mps[left ? kLeft : kRight],
      traction_n(profile, valid) / (profile.body.mass_kg * kStandardGravity_mps2)};
}

bool pumps_neutral(const DozerProfile& profile, const DozerValid& valid) {
  return std::all_of(valid.pump_ratio.begin(), valid.pump_ratio.end(), [&profile](double ratio) {
    return std::abs(ratio) <= profile.safety.displacement_tolerance;
  });
}

}  // namespace graben
