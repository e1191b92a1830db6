// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/estimation/oil/oil_cycle.hpp"

#include <cmath>

#include "firmware/core/time.hpp"

namespace graben {

double newest_of_lag(double lag_s) { return 1.0 - std::exp(-kCyclePeriod_s / lag_s); }

ModeTurn mode_turn(double omega_radps, double time_s) {
  const double turn = omega_radps * time_s;
  const double sine = std::sin(turn);
  const double cosine = std::cos(turn);
  return {cosine, sine / omega_radps, 1.0 - cosine, omega_radps * sine};
}

}  // namespace graben
