// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Figures of a drive's part of a recording, before anything is fitted.

#include <cstddef>
#include <vector>

#include "app/identify/verdict/tracks.hpp"

namespace graben::identify {

/// Between times that a gap may part: longer steps are none. s
inline constexpr double kGap_s = 0.5;
[[nodiscard]] double usual_step(const std::vector<double>& time_s);

/// All but the rate, from the pieces.
[[nodiscard]] TrackFigures figures_of(const Tracks& tracks, std::size_t at);

/// New values a second: a sensor may be slower than the rows that repeat it. It moves where it goes
/// by more than `moving_step` in eight rows.
[[nodiscard]] double new_rate_hz(const Signal& signal, double moving_step);

}  // namespace graben::identify
