#pragma once
/// A measured quantity that cannot jump: the last value that was believed, and for how long.

#include "firmware/safety/freshness.hpp"

namespace graben {

/// What is kept of such a signal from cycle to cycle.
struct Believed {
  Signal<double> signal;  ///< Last one that was believed.
  TimeUs seen_us = 0;     ///< Stamp of the last one, believed or not.
};

/// How a quantity may change.
struct ChangeLimit {
  double most_ps = 0.0;  ///< Per second, either way.
  double margin = 0.0;   ///< At once: noise, and frames that were lost.
  Fault jump = Fault::kNone;
  double expected_ps = 0.0;  ///< Counted off before: a rate that is measured too.
};

struct BelievedResult {
  bool jumped = false;
  FaultSet faults;  ///< `jump`; kSensorError where the sender calls its value wrong.
  Believed state;
};

/// What to believe after `next` came. One that changed faster than `change` allows is not: the last
/// one stays, however old it has become. It has to run out of time, not to give way to the jump.
/// Frames that were lost give the quantity time to change, frames that were refused do not: else a
/// jump that stays would be allowed as soon as it is old enough. Nothing is left to believe of a
/// signal that may not be used.
[[nodiscard]] BelievedResult believe(const Signal<double>& next, const ChangeLimit& change,
                                     const Freshness& fresh, const Believed& last);

}  // namespace graben
