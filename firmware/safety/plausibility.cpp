// SPDX-License-Identifier: Apache-2.0
#include "firmware/safety/plausibility.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/core/whole.hpp"

namespace graben {

Freshness::Freshness(double timeout_s, TimeUs now_us)
    : timeout_us_(static_cast<TimeUs>(timeout_s * kMicrosecondsPerSecond)), now_us_(now_us) {}

void read_required(const Required& row, const Freshness& fresh, FaultSet& faults) {
  if (fresh.number(*row.from)) {
    *row.to = row.from->value;
  } else {
    faults.add(row.missing);
  }
  if (row.from->validity == Validity::kError) {
    faults.add(row.wrong);
  }
}

namespace {

bool jumps(const Signal<double>& next, const ChangeLimit& change, const Believed& last) {
  const TimeUs from_us = std::max(last.signal.stamp_us, last.seen_us);
  const double elapsed_s = as_double(next.stamp_us - from_us) / kMicrosecondsPerSecond;
  const double unexpected = next.value - last.signal.value - change.expected_ps * elapsed_s;
  return std::abs(unexpected) > change.most_ps * elapsed_s + change.margin;
}

}  // namespace

BelievedResult believe(const Signal<double>& next, const ChangeLimit& change,
                       const Freshness& fresh, const Believed& last) {
  BelievedResult result;
  if (fresh.number(next)) {
    result.jumped = last.signal.validity == Validity::kValid && jumps(next, change, last);
    result.state.signal = result.jumped ? last.signal : next;
  }
  if (result.jumped) {
    result.faults.add(change.jump);
  }
  if (next.validity == Validity::kError) {
    result.faults.add(Fault::kSensorError);
  }
  result.state.seen_us = next.stamp_us;
  return result;
}

}  // namespace graben
