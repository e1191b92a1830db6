// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Pressure sensors that show nothing below 0: what their readings say when a chamber is nearly
/// empty.

#include <cstddef>
#include <optional>
#include <vector>

#include "app/identify/machine/machine_log.hpp"

namespace graben::identify {

struct ClippedZero {
  double value_pa = 0.0;
  double deviation_pa = 0.0;  ///< Of the readings' noise alone.
};

/// Most likely zero z of readings max(0, z + noise), the noise normal with this deviation above 0:
/// how many readings are 0 tells as much as how large the others are. Nothing where none is above
/// 0, or there are none. Pa.
[[nodiscard]] std::optional<ClippedZero> clipped_zero(const std::vector<double>& readings_pa,
                                                      double noise_pa);

/// What a sensor with this noise would show on average, if it could show less than 0, where its
/// readings' mean is this; not below -2 deviations of the noise. Pa.
[[nodiscard]] double unclipped_mean(double mean_pa, double noise_pa);

/// Deviation of the noise of an axis' pressures, which change slowly beside it: by the median of
/// their differences from reading to reading, away from 0. Pa; 0 where there are none.
[[nodiscard]] double pressure_noise_pa(const std::vector<MachineLog>& logs, std::size_t axis);

}  // namespace graben::identify
