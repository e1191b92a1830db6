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

FaultSet watch_tracks(const DozerValid& valid, bool asked, double wanted_mps, double period_s,
                      std::array<TrackRestState, kTrackCount>& state, FaultSet& said) {
  constexpr RestBounds kBounds = {kTrackRest_m, kTrackRest_s, kTrackCoast_s, 0.0};
  FaultSet stops;
  for (unsigned i = 0; i < kTrackCount; ++i) {
    TrackRestState& track = state[i];
    if (asked) {
      track.way_m = 0.0;
      ask_of(kBounds, wanted_mps, track.rest);
    } else if (valid.faults.has(Fault::kTransmissionMissing)) {
      track.rest.anchored = false;
    } else {
      // A track whose sensor is wrong runs nowhere: the body goes along with one that does.
      const double track_mps = valid.track_speed_mps[i];
      const bool body = !valid.faults.has(Fault::kPoseMissing) &&
                        std::abs(valid.velocity_mps) < std::abs(track_mps);
      track.way_m += period_s * (body ? valid.velocity_mps : track_mps);
      const RestSeen seen = {track.way_m, false, valid.by_hand()};
      if (watch_rest(kBounds, seen, period_s, track.rest) == RestVerdict::kMoves) {
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
  stops.add(watch_tracks(valid, last.drives.active, last.speed_mps, period_s, state.track, said));
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
  const bool runs_away =
      valid.faults.has(Fault::kDisplacementRunaway) || mode.fault == Fault::kDisplacementRunaway;
  if (in_motion(mode.mode)) {
    return {runs_away, 0.0};
  }
  const double coasting_s = std::min(last.coasting_s + period_s, 2.0 * kCoasting_s);
  const bool at_rest = valid.faults.has(Fault::kTransmissionMissing) ? coasting_s > kCoasting_s
                                                                     : tracks_at_rest(valid);
  return {runs_away || at_rest || (last.wanted && !valid.by_hand()), coasting_s};
}

}  // namespace graben
