#include "firmware/dozer/safety/dozer_watch.hpp"

namespace graben {
namespace {

DisplacementTask displacement_task(bool returning, bool moving, const DozerValid& valid) {
  if (!returning || valid.faults.has(Fault::kTransmissionMissing)) {
    return DisplacementTask::kNone;
  }
  return moving ? DisplacementTask::kFollow : DisplacementTask::kReturn;
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
  stop(stops, valid);
  state.slowing =
      slow_down(profile.safety.degraded_speed_ratio, state.slowing, moving, period_s, valid);
}

}  // namespace graben
