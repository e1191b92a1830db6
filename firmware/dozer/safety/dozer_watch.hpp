// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The dozer against its commands: the watches of blade and transmission, and the parking brake.

#include "firmware/dozer/safety/dozer_validation.hpp"
#include "firmware/dozer/safety/pose_watch.hpp"
#include "firmware/dozer/safety/transmission_watch.hpp"
#include "firmware/dozer/safety/tuning.hpp"
#include "firmware/drives/drive_watch.hpp"
#include "firmware/safety/common_inputs.hpp"
#include "firmware/safety/mode.hpp"

namespace graben {

/// A track that nobody asks to run.
struct TrackRestState {
  double way_m = 0.0;
  RestState rest;
};

struct DozerWatchState {
  DriveWatchState<kBladeCount, 0> drives;  ///< Its inlets meter the flow.
  TransmissionWatchState transmission;
  PoseWatchState pose;
  SlowingState slowing;
  std::array<TrackRestState, kTrackCount> track;
  bool returning = false;  ///< It was in motion, and some pump has not been near 0 since.
};

/// Commands of the last cycle.
struct DozerLastCommands {
  LastCommands<kBladeCount> drives;
  SentRatios ratios;
  double speed_mps = 0.0;  ///< v_c; 0 out of motion.
};

/// Adds the watches' faults to `valid`; takes off the operator's speed (`safety.degraded_speed`)
/// while anything is degraded, and for kSlowAfter_s after. `state` goes on by a cycle. See
/// watch_drives():
/// the displacements are checked outside motion too, until they have been neutral once or the
/// operator has taken over in manual mode; what stays stroked when the deadman is let go runs away.
/// So does, in any mode but manual, a track that runs on though nothing is asked of it
/// (watch_rest()), whatever its displacements say, by its own speed or the body's.
void watch(const DozerProfile& profile, DriveRows drives, const DozerLastCommands& last,
           double period_s, DozerWatchState& state, DozerValid& valid);

/// Both tracks stand: none is faster than kTrackAtRest_mps.
[[nodiscard]] bool tracks_at_rest(const DozerValid& valid);

/// A track's speed as it may be fed back. Where one of them is not that of its displacements, none
/// is believed, and one that is outvoted never: a wrong one would drive its track off.
[[nodiscard]] double believed_track_mps(const HstProfile& hst, const DozerValid& valid,
                                        unsigned track);

/// State of the brake from cycle to cycle.
struct BrakeState {
  bool wanted = true;
  double coasting_s = 0.0;  ///< Since the last motion.
};

/// Wanted at once while a displacement runs away or has stopped the machine by that. In motion not.
/// Otherwise from when both tracks have come to rest, and then until the next motion: a machine
/// that is dragged downhill keeps its brake. In manual mode only while the tracks are at rest, and
/// with enable released whatever ran away before: the machine is its operator's. `mode` is this
/// cycle's.
[[nodiscard]] BrakeState brake(const BrakeState& last, const ModeState& mode,
                               const DozerValid& valid, double period_s);

}  // namespace graben
