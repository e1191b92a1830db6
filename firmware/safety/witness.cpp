// SPDX-License-Identifier: Apache-2.0
#include "firmware/safety/witness.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/core/whole.hpp"
#include "firmware/safety/plausibility.hpp"
#include "firmware/safety/tuning.hpp"

namespace graben {
namespace {

double seconds(TimeUs from_us, TimeUs to_us) {
  return as_double(to_us - from_us) / kMicrosecondsPerSecond;
}

}  // namespace

bool contradicts(const WitnessBand& band, double first, const Signal<double>& second, bool learns,
                 TimeUs now_us, WitnessState& state) {
  if (state.begun && second.stamp_us <= state.stamp_us) {
    return state.apart >= kWitnessApart;
  }
  const WitnessState last = state;
  state.begun = true;
  state.first = first;
  state.stamp_us = second.stamp_us;
  if (!last.begun) {
    return false;
  }
  const double shown_ps = (first - last.first) / seconds(last.stamp_us, second.stamp_us);
  const double speed_ps = std::clamp(shown_ps, -band.fastest_ps, band.fastest_ps);
  const double age_s =
      seconds(second.stamp_us, now_us) + 0.5 * (band.least_age_s + band.most_age_s);
  const double moved =
      std::abs(speed_ps) * (0.5 * (band.most_age_s - band.least_age_s) + kWitnessPhase_s);
  const double difference = second.value - (first - speed_ps * age_s);
  // As they cannot be installed.
  const bool strange = std::abs(difference) > band.offset + band.scale * std::abs(first) + moved;
  if (!last.known && !strange) {
    state.known = true;
    state.difference = difference;
    state.at = first;
  }
  const bool apart = strange || std::abs(difference - state.difference) >
                                    band.play + band.scale * std::abs(first - state.at) + moved;
  state.apart = apart ? std::min(last.apart + 1, kWitnessApart + 1) : 0;
  if (learns && !strange) {
    state.difference += kWitnessLearns * (difference - state.difference);
    state.at = first;
  }
  return state.apart >= kWitnessApart;
}

}  // namespace graben
