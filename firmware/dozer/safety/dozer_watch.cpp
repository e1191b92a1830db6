// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/safety/dozer_watch.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/dozer/grade_profile.hpp"
#include "firmware/dozer/travel/tracks.hpp"

namespace graben {
namespace {

DisplacementTask displacement_task(bool returning, bool moving, const DozerValid& valid) {
  if (!returning || valid.faults.has(Fault::kTransmissionMissing)) {
    return DisplacementTask::kNone;
  }
  return moving ? DisplacementTask::kFollow : DisplacementTask::kReturn;
}

/// How fast a track runs, by itself and by the body. A track whose sensor is wrong runs nowhere:
/// the body goes along with one that does. Where only one of them is known, that; and what may be
/// the zero of its sensor is none.
double runs_mps(const DozerValid& valid, unsigned track) {
  const bool track_known = !valid.faults.has(Fault::kTransmissionMissing);
  const bool body_known = !valid.faults.has(Fault::kPoseMissing);
  const double track_mps = track_known ? valid.track_speed_mps[track] : valid.velocity_mps;
  const double body_mps = body_known ? valid.velocity_mps : track_mps;
  const double least_mps = std::abs(body_mps) < std::abs(track_mps) ? body_mps : track_mps;
  return (track_known || body_known) && std::abs(least_mps) > kTrackZero_mps ? least_mps : 0.0;
}

FaultSet watch_tracks(const HstProfile& hst, const DozerValid& valid, bool asked, double wanted_mps,
                      double period_s, std::array<TrackRestState, kTrackCount>& state,
                      FaultSet& said) {
  const RestBounds bounds = {kTrackRest_m, kTrackRest_s, kTrackCoast_s,
                             track_speed_max_mps(hst, valid.engine_radps), 0.0};
  FaultSet stops;
  for (unsigned i = 0; i < kTrackCount; ++i) {
    TrackRestState& track = state[i];
    if (asked) {
      track.way_m = 0.0;
      ask_of(bounds, wanted_mps, track.rest);
    } else {
      track.way_m += period_s * runs_mps(valid, i);
      const RestSeen seen = {track.way_m, false, valid.by_hand()};
      if (watch_rest(bounds, seen, period_s, track.rest) == RestVerdict::kMoves) {
        (valid.by_hand() ? said : stops).add(Fault::kDisplacementRunaway);
      }
    }
  }
  return stops;
}

}  // namespace

void watch(const DozerProfile& profile, DriveRows drives, const DozerLastCommands& last,
           double period_s, DozerWatchState& state, DozerValid& valid) {
  const bool moving = last.drives.moving;
  FaultSet stops =
      watch_drives(drives, profile.bus, last.drives, valid.drive, period_s, state.drives, valid);
  state.returning = moving || still_closing(state.returning, pumps_neutral(profile, valid),
                                            Fault::kTransmissionMissing, valid);
  const TransmissionWatchResult transmission =
      watch_transmission(profile, state.transmission, last.ratios,
                         displacement_task(state.returning, moving, valid), valid, period_s);
  stops.add(transmission.stops);
  if (transmission.tracks_disagree) {
    degrade(Fault::kTrackSpeedDisagrees, valid);
  }
  if (!moving || valid.fault != Fault::kNone) {
    state.pose = {};
  } else if (watch_pose(valid, ground_speeds(profile, valid),
                        curvature_at(profile.grade.heights, valid.position_m), period_s,
                        state.pose)) {
    stops.add(Fault::kPoseDisagrees);
  }
  FaultSet said;
  stops.add(watch_tracks(profile.hst, valid, last.drives.active, last.speed_mps, period_s,
                         state.track, said));
  if (!said.empty()) {
    warn(Fault::kDisplacementRunaway, valid);
  }
  stop(stops, valid);
  state.slowing =
      slow_down(profile.safety.degraded_speed_ratio, state.slowing, moving, period_s, valid);
}

bool tracks_at_rest(const DozerValid& valid) {
  return std::all_of(valid.track_speed_mps.begin(), valid.track_speed_mps.end(),
                     [](double speed) { return std::abs(speed) <= kTrackAtRest_mps; });
}

double believed_track_mps(const HstProfile& hst, const DozerValid& valid, unsigned track) {
  return valid.degraded.has(Fault::kTrackSpeedDisagrees) || valid.track_outvoted[track]
             ? track_speed_mps(hst, valid.engine_radps, valid.pump_ratio[track],
                               valid.motor_ratio[track])
             : valid.track_speed_mps[track];
}

BrakeState brake(const BrakeState& last, const ModeState& mode, const DozerValid& valid,
                 double period_s) {
  const bool his = valid.by_hand() && !valid.enable;
  const bool runs_away = !his && (valid.faults.has(Fault::kDisplacementRunaway) ||
                                  mode.fault == Fault::kDisplacementRunaway);
  if (in_motion(mode.mode)) {
    return {runs_away, 0.0};
  }
  const double coasting_s = std::min(last.coasting_s + period_s, 2.0 * kCoasting_s);
  const bool at_rest = valid.faults.has(Fault::kTransmissionMissing) ? coasting_s > kCoasting_s
                                                                     : tracks_at_rest(valid);
  return {runs_away || at_rest || (last.wanted && !valid.by_hand()), coasting_s};
}

}  // namespace graben
