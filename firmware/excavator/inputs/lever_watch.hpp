// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Whether the operator's levers still live. A hand does not tell: on the bus a lever has steps of
/// 0.8 % of its travel, and at a stop or by a key it stands for good. But a station may promise
/// that what it sends of a lever off its middle changes (`graben operate` takes a step of it off
/// every second frame): then the same for long, under a counter that goes on, comes from what no
/// longer reads them.
///
/// All levers count together: they come in one frame, and one that changes shows that it is made
/// anew. In their middle they ask for nothing and may stand. At an end they may not: the station
/// that promises takes its step off there too, which a hand could not.

#include <algorithm>
#include <array>

#include "firmware/excavator/excavator_signals.hpp"

namespace graben {

/// From cycle to cycle. As constructed nothing has been seen. Its time has a bound, twice that of
/// the promise.
struct LeverWatch {
  std::array<double, kDriveCount> lever_ratio{};  ///< As they were last.
  /// Since then; what is beyond twice the promise does not matter.
  double same_s = 0.0;
};

/// A cycle on. True where levers off their middle have been the same for longer than `alive_s`; 0:
/// nothing is promised. `followed`: the machine moves by them, else it begins newly.
/// `lever_ratio` as received, -1 .. 1; `period_s` since the cycle before.
[[nodiscard]] inline bool levers_stand_still(double alive_s, bool followed,
                                             const std::array<double, kDriveCount>& lever_ratio,
                                             double period_s, LeverWatch& state) {
  const bool rest = std::all_of(lever_ratio.begin(), lever_ratio.end(),
                                [](double ratio) { return ratio == 0.0; });
  const bool same = followed && !rest && lever_ratio == state.lever_ratio;
  state.lever_ratio = lever_ratio;
  state.same_s = same ? std::min(state.same_s + period_s, 2.0 * alive_s) : 0.0;
  return alive_s > 0.0 && state.same_s > alive_s;
}

}  // namespace graben
