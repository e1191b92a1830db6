// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a ramp shows of signs: a stroke that goes against the duty of its drive, or one that moves
/// while only another drive is told to.

#include <array>
#include <optional>
#include <string>

#include "app/commission/commission_plan.hpp"

namespace graben::commission {

struct WrongWay {
  int axis = 0;  ///< Whose duty is tried.
  int sign = 0;  ///< Its way.
  int seen = 0;  ///< Whose stroke moves as it must not; `axis` itself: against its duty.
};

/// What has gone wrong since the ramp began at `begin_m`, at the speeds of now. Less than a
/// linkage rocks on its oil, and what creeps, is nothing.
[[nodiscard]] std::optional<WrongWay> look_for_wrong_way(
    const SequenceStep& ramp, const std::array<double, kAxisCount>& begin_m,
    const std::array<double, kAxisCount>& now_m, const std::array<double, kAxisCount>& speed_mps);

/// "the boom's stroke falls while it is told to extend: sensor or valve reversed".
[[nodiscard]] std::string wrong_text(const WrongWay& wrong);

}  // namespace graben::commission
