// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Checks that the dozer's transmission obeys, and that the tracks run as it lets them.

#include <array>

#include "firmware/dozer/safety/displacement_watch.hpp"
#include "firmware/dozer/safety/dozer_validation.hpp"
#include "firmware/dozer/safety/pose_watch.hpp"

namespace graben {

/// Commands to the transmission in one cycle.
struct SentRatios {
  std::array<double, kTrackCount> pump{};
  std::array<double, kTrackCount> motor = {1.0, 1.0};
};

/// State of the watch from cycle to cycle.
struct TransmissionWatchState {
  std::array<DisplacementState, kTrackCount> pump = {DisplacementState(0.0),
                                                     DisplacementState(0.0)};
  std::array<DisplacementState, kTrackCount> motor = {DisplacementState(1.0),
                                                      DisplacementState(1.0)};
  std::array<double, kTrackCount> track_off_s{};
  std::array<double, kTrackCount> outvoted_s{};
  double apart_s = 0.0;  ///< The tracks have differed in what their sensors say beyond (9).
  double stood_s = 0.0;  ///< Both have stood, unpressed, though (9) has them run.
};

struct TransmissionWatchResult {
  /// kDisplacementDisagrees, kDisplacementRunaway, kEngineDoubtful, kTracksAstray
  FaultSet stops;
  bool tracks_disagree = false;
};

/// `state` goes on by a cycle. Each displacement as watch_displacement has it. In motion also the
/// tracks: one whose speed has been off that of (9), with measured displacements and engine speed,
/// by more than `safety.track_speed_tolerance_mps` and a tenth of it for longer than 0.3 s,
/// disagrees. On the simulated machine (2026-11) losses that the profile has wrong by as much again
/// are 0.38 m/s at 2.6 m/s; stopping at once from 1.8 m/s gives 0.56 m/s, over 0.35 for 0.09 s.
/// Without an engine speed it isn't judged.
///
/// A sensor is outvoted (`valid.track_outvoted`, in this cycle already) where its speed is neither
/// that of (9) nor the body's; outvoted for 0.1 s, it disagrees. So do both after 0.2 s in which
/// one of them is further from (9) than the other: losses and slip are the same on both sides of a
/// machine that goes straight on, and a sensor that shows a share of its speed turns it. On a track
/// that curves, where they are not, it has to be more.
///
/// Where the body goes along with both tracks, it is what (9) is made of that lies, and that stops:
/// kTracksAstray, and kDisplacementRunaway with it, where both have been faster than (9) for so
/// long that each disagrees: to be told to be slower does not reach them. Where they are slower,
/// losses may be wrong, or a load holds them, and they only disagree. kEngineDoubtful where both
/// have stood for 0.3 s, at less than 0.3 of the speed of (9), above 0.1 m/s, unless the lines
/// press with more than the slope takes, by a twentieth of the weight: then a load holds them. A
/// machine that does not tell its lines' pressures counts as not pressing.
[[nodiscard]] TransmissionWatchResult watch_transmission(const DozerProfile& profile,
                                                         TransmissionWatchState& state,
                                                         const SentRatios& sent,
                                                         DisplacementTask task, DozerValid& valid,
                                                         double period_s);

/// What tracks and transmission say of the body's speed; without an engine speed the transmission
/// counts as the tracks do.
[[nodiscard]] GroundSpeeds ground_speeds(const DozerProfile& profile, const DozerValid& valid);

/// True where both pumps are near 0.
[[nodiscard]] bool pumps_neutral(const DozerProfile& profile, const DozerValid& valid);

}  // namespace graben
