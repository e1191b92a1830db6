#include "firmware/safety/degrade.hpp"

#include <algorithm>

namespace graben {
namespace {
constexpr double kSlowAfter_s = 0.5;
}

void stop(const FaultSet& faults, CommonValid& inputs) {
  inputs.faults.add(faults);
  if (inputs.fault == Fault::kNone) {
    inputs.fault = faults.first();
  }
}

void degrade(Fault fault, CommonValid& inputs) {
  inputs.faults.add(fault);
  inputs.degraded.add(fault);
}

SlowingState slow_down(double speed_ratio, const SlowingState& last, bool moving, double period_s,
                       CommonValid& inputs) {
  if (!moving) {
    return {};
  }
  SlowingState state = last;
  if (!inputs.degraded.empty()) {
    state.faults.add(inputs.degraded);
    state.for_s = kSlowAfter_s;
  } else {
    state.for_s = std::max(0.0, last.for_s - period_s);
    if (state.for_s <= 0.0) {
      state.faults = {};
    }
  }
  inputs.degraded = state.faults;
  if (!inputs.degraded.empty()) {
    inputs.speed_override_ratio *= speed_ratio;
  }
  return state;
}

bool still_closing(bool last, bool centred, Fault unknown, const CommonValid& inputs) {
  const bool closed = !inputs.faults.has(unknown) && centred;
  const bool by_hand = !inputs.faults.has(Fault::kOperatorMissing) && !inputs.automatic;
  return last && !closed && !by_hand;
}

}  // namespace graben
