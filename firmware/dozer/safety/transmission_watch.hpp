#pragma once
/// Checks that the dozer's transmission obeys, and that the tracks run as it lets them.

#include <array>

#include "firmware/dozer/safety/displacement_watch.hpp"
#include "firmware/dozer/safety/dozer_validation.hpp"

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
};

struct TransmissionWatchResult {
  FaultSet stops;  ///< kDisplacementDisagrees, kDisplacementRunaway
  bool tracks_disagree = false;
};

/// `state` goes on by a cycle. Each displacement as watch_displacement has it. In motion also the
/// tracks: one whose speed has been off that of (9), with measured displacements and engine speed,
/// by more than `safety.track_speed_tolerance_mps` and a tenth of it for longer than 0.3 s,
/// disagrees. On the simulated machine (2026-11) losses that the profile has wrong by as much again
/// are 0.38 m/s at 2.6 m/s; stopping at once from 1.8 m/s gives 0.56 m/s, over 0.35 for 0.09 s.
/// Without an engine speed it isn't judged.
[[nodiscard]] TransmissionWatchResult watch_transmission(const DozerProfile& profile,
                                                         TransmissionWatchState& state,
                                                         const SentRatios& sent,
                                                         DisplacementTask task,
                                                         const DozerValid& valid, double period_s);

/// True where both pumps are near 0.
[[nodiscard]] bool pumps_neutral(const DozerProfile& profile, const DozerValid& valid);

}  // namespace graben
