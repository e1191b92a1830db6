// SPDX-License-Identifier: Apache-2.0
#include "hal/link/dm1.hpp"

#include <algorithm>
#include <cstddef>

#include "firmware/safety/fault_table.hpp"

namespace graben {
namespace {

constexpr TimeUs kRoundUs = kSecondUs;
constexpr TimeUs kCallUs = 10 * kMillisecondUs;
constexpr TimeUs kShortestUs = 100 * kMillisecondUs;
constexpr TimeUs kSlackUs = kCallUs / 2;  ///< A call may come early by that.

TimeUs period_us(const FaultSet& active) {
  // In 32 bits: a library divides those of a time.
  const std::int32_t share_us = std::int32_t{kRoundUs} / std::max<std::int32_t>(active.count(), 1);
  return std::max<TimeUs>(share_us - share_us % std::int32_t{kCallUs}, kShortestUs);
}

/// Whether at least `period_us` have passed. A clock that went back is no reason to fall silent.
bool has_passed(TimeUs since_us, TimeUs period_us, TimeUs now) {
  return now < since_us || now - since_us >= period_us - kSlackUs;
}

}  // namespace

void Dm1::note(const FaultSet& active, TimeUs now) {
  for (Fault fault = active.first(); fault != Fault::kNone; fault = active.after(fault)) {
    if (active_.has(fault)) {
      continue;
    }
    Entry& of = entry(fault);
    of.occurrences =
        std::min<std::uint8_t>(static_cast<std::uint8_t>(of.occurrences + 1U), kDm1MaxOccurrences);
    of.is_new = !of.was_said || has_passed(of.said_us, kRoundUs, now);
  }
  active_ = active;
}

Fault Dm1::first_new() const {
  for (Fault fault = active_.first(); fault != Fault::kNone; fault = active_.after(fault)) {
    if (entries_[static_cast<std::size_t>(fault)].is_new) {
      return fault;
    }
  }
  return Fault::kNone;
}

Fault Dm1::overdue(TimeUs now) const {
  Fault longest = Fault::kNone;
  TimeUs said_us = now;
  for (Fault fault = active_.first(); fault != Fault::kNone; fault = active_.after(fault)) {
    const Entry& of = entries_[static_cast<std::size_t>(fault)];
    if (has_passed(of.said_us, kRoundUs, now) &&
        (longest == Fault::kNone || of.said_us < said_us)) {
      longest = fault;
      said_us = of.said_us;
    }
  }
  return longest;
}

Fault Dm1::next_in_turn(TimeUs now) const {
  const Fault late = overdue(now);
  const Fault next = late != Fault::kNone ? late : active_.after(last_);
  return next != Fault::kNone ? next : active_.first();
}

bool Dm1::is_turn(TimeUs now) const {
  return !has_started_ || has_passed(turn_us_, period_us(active_), now) ||
         (overdue(now) != Fault::kNone && has_passed(turn_us_, kShortestUs, now));
}

bool Dm1::due(const FaultSet& active, TimeUs now, Dm1Content& content) {
  note(active, now);
  Fault fault = first_new();
  const bool is_new = fault != Fault::kNone;
  if (!is_new && !is_turn(now)) {
    return false;
  }
  if (!is_new) {
    fault = next_in_turn(now);
    last_ = fault;
  }
  // A new fault is said beside the turns and does not hold them up.
  if (!is_new || !has_started_) {
    turn_us_ = now;
  }
  has_started_ = true;
  content = {};
  content.red_stop = has_red_stop(active);
  content.amber_warning = has_amber_warning(active);
  if (fault != Fault::kNone) {
    Entry& of = entry(fault);
    of.is_new = false;
    of.was_said = true;
    of.said_us = now;
    content.spn = kDm1FirstSpn + static_cast<std::uint32_t>(fault);
    content.fmi = fault_row(fault).fmi;
    content.occurrences = of.occurrences;
  }
  return true;
}

}  // namespace graben
