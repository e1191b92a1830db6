#include "firmware/dozer/safety/transmission_watch.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/dozer/travel/tracks.hpp"

namespace graben {
namespace {

constexpr double kTrackOff_s = 0.3;
/// Losses that the profile does not know, of the speed.
constexpr double kLossShare = 0.1;

/// Takes in what one displacement's watch says.
void take(const DisplacementResult& result, FaultSet& stops) {
  if (result.disagrees) {
    stops.add(Fault::kDisplacementDisagrees);
  }
  if (result.runs_away) {
    stops.add(Fault::kDisplacementRunaway);
  }
}

bool track_is_off(const DozerProfile& profile, const DozerValid& valid, unsigned track) {
  const double expected_mps = track_speed_mps(profile.hst, valid.engine_radps,
                                              valid.pump_ratio[track], valid.motor_ratio[track]);
  return std::abs(valid.track_speed_mps[track] - expected_mps) >
         profile.safety.track_speed_tolerance_mps + kLossShare * std::abs(expected_mps);
}

}  // namespace

TransmissionWatchResult watch_transmission(const DozerProfile& profile,
                                           TransmissionWatchState& state, const SentRatios& sent,
                                           DisplacementTask task, const DozerValid& valid,
                                           double period_s) {
  const DisplacementLimits limits{profile.safety.displacement_tolerance,
                                  profile.safety.displacement_settle_s};
  const bool tracks_judged =
      task == DisplacementTask::kFollow && !valid.faults.has(Fault::kEngineSpeedMissing);
  TransmissionWatchResult result;
  const std::array<double, kTrackCount> last_off_s = state.track_off_s;
  state.track_off_s = {};
  for (unsigned i = 0; i < kTrackCount; ++i) {
    take(watch_displacement(limits, state.pump[i], sent.pump[i], task, valid.pump_ratio[i],
                            period_s),
         result.stops);
    take(watch_displacement(limits, state.motor[i], sent.motor[i], task, valid.motor_ratio[i],
                            period_s),
         result.stops);
    if (tracks_judged && track_is_off(profile, valid, i)) {
      state.track_off_s[i] = last_off_s[i] + period_s;
    }
    result.tracks_disagree = result.tracks_disagree || state.track_off_s[i] > kTrackOff_s;
  }
  return result;
}

bool pumps_neutral(const DozerProfile& profile, const DozerValid& valid) {
  return std::all_of(valid.pump_ratio.begin(), valid.pump_ratio.end(), [&profile](double ratio) {
    return std::abs(ratio) <= profile.safety.displacement_tolerance;
  });
}

}  // namespace graben
