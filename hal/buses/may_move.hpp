// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Whether an excavator's commands may be sent as they are, on whatever bus.

#include <cmath>

#include "firmware/excavator/excavator_signals.hpp"

namespace graben {

/// Enabled, and every duty is a number; else everything that is sent is neutral.
[[nodiscard]] inline bool may_move(const ExcavatorOutputs& outputs) {
  bool finite = true;
  for (const double duty_ratio : outputs.duty_ratio) {
    finite = finite && std::isfinite(duty_ratio);
  }
  return outputs.enable && finite;
}

}  // namespace graben
