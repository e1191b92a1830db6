#include "firmware/dozer/safety/brake.hpp"

#include <algorithm>
#include <cmath>

namespace graben {
namespace {

bool tracks_at_rest(const DozerValid& valid) {
  return std::all_of(valid.track_speed_mps.begin(), valid.track_speed_mps.end(),
                     [](double speed) { return std::abs(speed) <= kTrackAtRest_mps; });
}

}  // namespace

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
  const bool by_hand = !valid.faults.has(Fault::kOperatorMissing) && !valid.automatic;
  return {runs_away || at_rest || (last.wanted && !by_hand), coasting_s};
}

}  // namespace graben
