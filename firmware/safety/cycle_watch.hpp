#pragma once
/// The controller's own cycle: how long since the last one, and whether that is too long.

#include "firmware/core/codes.hpp"
#include "firmware/core/time.hpp"

namespace graben {

/// What the watch needs of the last cycle.
struct CycleState {
  TimeUs last_us = 0;
  int late_cycles = 0;  ///< In a row.
  bool has_stepped = false;
};

struct CycleWatchResult {
  /// kCycleStalled: so long without a cycle that it is not known what the machine did meanwhile.
  /// kCycleOverrun: the second in a row that came late.
  Fault fault = Fault::kNone;
  double elapsed_s = 0.0;  ///< Since the last cycle, up to what is a stall; 0 in the first.
  double period_s = 0.0;   ///< The same for what may change by so much a second.
  CycleState state;
};

/// `now_us` must not fall from call to call.
[[nodiscard]] CycleWatchResult watch_cycle(const CycleState& last, TimeUs now_us);

}  // namespace graben
