#pragma once
/// What of a signal may be used now, and the rows in which required numbers are listed.

#include <cmath>

#include "firmware/core/fault_set.hpp"
#include "firmware/signals/signal.hpp"

namespace graben {

inline constexpr double kMicrosecondsPerSecond = 1e6;

class Freshness {
 public:
  Freshness(double timeout_s, TimeUs now_us)
      : timeout_us_(static_cast<TimeUs>(timeout_s * kMicrosecondsPerSecond)), now_us_(now_us) {}

  [[nodiscard]] bool in_time(TimeUs stamp_us) const {
    // A stamp from the future is as useless as an old one. No difference with a stamp: any number
    // can stand there.
    return stamp_us <= now_us_ && stamp_us >= now_us_ - timeout_us_;
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

}  // namespace graben
