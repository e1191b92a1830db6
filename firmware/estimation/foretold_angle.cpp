// SPDX-License-Identifier: Apache-2.0
#include "firmware/estimation/foretold_angle.hpp"

#include <cstddef>

#include "firmware/core/whole.hpp"

namespace graben {

Signal<double> foretold(const Signal<double>& shown, double latency_s, ForetoldAngle& state) {
  if (shown.validity != Validity::kValid) {
    state = {};
    return shown;
  }
  if (!state.reading[0].known || state.reading[0].stamp_us != shown.stamp_us) {
    for (std::size_t i = kForetoldReadings; i > 0; --i) {
      state.reading[i] = state.reading[i - 1];
    }
    state.reading[0] = {true, shown.value, shown.stamp_us};
  }
  const ForetoldAngle::Reading& before = state.reading[kForetoldReadings];
  const TimeUs passed_us = shown.stamp_us - before.stamp_us;
  Signal<double> ahead = shown;
  if (before.known && passed_us > 0 && passed_us <= kForetoldLongest_us) {
    ahead.value += latency_s * kSecondUs / as_double(passed_us) *
                   (state.reading[0].angle_rad - before.angle_rad);
  }
  return ahead;
}

}  // namespace graben
