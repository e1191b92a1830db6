#pragma once
/// Whether the pumps are at the displacement they were told to be.

#include <array>

#include "firmware/excavator/excavator_profile.hpp"
#include "firmware/excavator/safety/excavator_validation.hpp"

namespace graben {

/// How long each pump's swash has differed from its command, s.
using SwashWatchState = std::array<double, kPumpCount>;

struct SwashWatchResult {
  bool disagrees = false;
  SwashWatchState state{};
  std::array<double, kPumpCount> flow_swash_ratio{};  ///< What the flow may be reckoned with.
};

/// A pump disagrees when its swash has been off its command by more than `safety.swash_tolerance`
/// for longer than 0.5 s, which its servo takes at most. Then the smaller of the two counts.
/// Without a command nothing is asked of it.
[[nodiscard]] SwashWatchResult watch_swash(const ExcavatorProfile& profile,
                                           const SwashWatchState& last, bool commanded,
                                           const std::array<double, kPumpCount>& swash_ratio,
                                           double period_s);

}  // namespace graben
