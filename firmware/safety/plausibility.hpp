// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Signals that may be used now: fresh and valid, and they cannot have jumped.

#include <cmath>

#include "firmware/core/fault_set.hpp"
#include "firmware/core/time.hpp"
#include "firmware/core/whole.hpp"
#include "firmware/signals/signal.hpp"

namespace graben {

/// Microseconds of a second, as a divisor of their number. [-; derived: kSecondUs]
inline constexpr double kMicrosecondsPerSecond = double{kSecondUs};

class Freshness {
 public:
  Freshness(double timeout_s, TimeUs now_us);

  [[nodiscard]] bool in_time(TimeUs stamp_us) const {
    // A stamp from the future is as useless as an old one. No difference with a stamp: any number
    // can stand there.
    return stamp_us <= now_us_ && stamp_us >= now_us_ - timeout_us_;
  }
  /// Since then, s.
  [[nodiscard]] double age_s(TimeUs stamp_us) const {
    return as_double(now_us_ - stamp_us) / kMicrosecondsPerSecond;
  }
  template <class T>
  [[nodiscard]] bool holds(const Signal<T>& signal) const {
    return signal.validity == Validity::kValid && in_time(signal.stamp_us);
  }
  [[nodiscard]] bool number(const Signal<double>& signal) const {
    return holds(signal) && std::isfinite(signal.value);
  }

 private:
  TimeUs timeout_us_;
  TimeUs now_us_;
};

/// A required number: where it comes from, where it goes, what its absence means, and what it
/// means that its sender calls it wrong.
struct Required {
  const Signal<double>* from = nullptr;
  double* to = nullptr;
  Fault missing = Fault::kNone;
  Fault wrong = Fault::kNone;
};

/// Reads one of them; what is missing stays as it was.
void read_required(const Required& row, const Freshness& fresh, FaultSet& faults);

/// State of such a signal from cycle to cycle.
struct Believed {
  Signal<double> signal;  ///< Last one that was believed.
  TimeUs seen_us = 0;     ///< Stamp of the last one, believed or not.
};

/// Limits on the change of a quantity.
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

/// Value to use after `next` came. One that changed faster than `change` allows is not: the last
/// one stays, however old it has become. It has to run out of time, not to give way to the jump.
/// Frames that were lost give the quantity time to change, frames that were refused do not: else a
/// jump that stays would be allowed as soon as it is old enough. Nothing is left to believe of a
/// signal that may not be used.
[[nodiscard]] BelievedResult believe(const Signal<double>& next, const ChangeLimit& change,
                                     const Freshness& fresh, const Believed& last);

}  // namespace graben
