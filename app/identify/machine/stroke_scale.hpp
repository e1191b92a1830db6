// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Whether a stroke sensor shows what its cylinder goes. A sensor that shows half of it makes every
/// speed half: each of the cylinder's four metering areas, by the oil that the pump and the other
/// chamber's pressure say has flowed, seems half of the profile's. One area may well be far off;
/// that all four are, by the same share, is hardly ever the valve.

#include <array>
#include <string>
#include <vector>

#include "app/identify/machine/estimate.hpp"

namespace graben::identify {

/// Of the stroke that a cylinder goes, what is shown: the mean of its areas' factors, each by what
/// is known of it. Where the sensor is wrong it is farther off than that: a speed that is half has
/// the pump's line at a pressure that the valve would have to throttle.
struct StrokeScale {
  bool known = false;  ///< Both sides were driven.
  double ratio = 1.0;
};

[[nodiscard]] std::array<StrokeScale, kAxisCount> stroke_scales(const MachineEstimate& machine);

/// A sentence for each cylinder whose stroke may be shown at another scale.
[[nodiscard]] std::vector<std::string> scale_notes(const MachineEstimate& machine);

/// Throws std::runtime_error for the first cylinder that must be measured before anything is made
/// of its log.
void assert_scales(const MachineEstimate& machine);

}  // namespace graben::identify
