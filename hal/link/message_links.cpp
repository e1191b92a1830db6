// SPDX-License-Identifier: Apache-2.0
#include "hal/link/message_links.hpp"

#include <algorithm>

namespace graben {
namespace {

void increment(std::uint32_t& counter) {
  if (counter < UINT32_MAX) {
    ++counter;
  }
}

std::uint32_t LinkCounters::*counter_of(E2eCheck check) {
  switch (check) {
    case E2eCheck::kSynchronising:
      return &LinkCounters::synchronising;
    case E2eCheck::kWrongCrc:
      return &LinkCounters::wrong_crc;
    case E2eCheck::kRepeated:
    case E2eCheck::kWrongSequence:
    case E2eCheck::kConflict:
    case E2eCheck::kTooMany:
    case E2eCheck::kNoNewData:
    case E2eCheck::kOk:
    case E2eCheck::kSomeLost:
      break;
  }
  return &LinkCounters::wrong_counter;
}

E2eMark mark_of(E2eCheck check) {
  return e2e_accepted(check) || check == E2eCheck::kSynchronising ? E2eMark::kGood
                                                                  : E2eMark::kSequence;
}

}  // namespace

MessageLinks::MessageLinks(const MessageRules& rules, const BusParts& parts) : rules_(rules) {
  for (std::size_t i = 0; i < rules_.count; ++i) {
    if (has_part(parts, rules_.rule[i].part)) {
      const std::uint32_t identity = identity_of(rules_.rule[i].id);
      known_[place_of(identity)] = {identity, static_cast<int>(i)};
    }
  }
  for (std::size_t i = 0; i < rules_.all_count; ++i) {
    if ((rules_.all[i].id & 0xFFU) == kOwnAddress) {
      const std::uint32_t identity = identity_of(rules_.all[i].id);
      known_[place_of(identity)] = {identity, kOwnMessage};
    }
    if (rules_.all[i].is_protected) {
      fits_a_message_[e2e_signature(rules_.all[i].data_id)] = true;
    }
  }
}

/// Where the identity is, or where it would be.
std::size_t MessageLinks::place_of(std::uint32_t identity) const {
  constexpr std::uint32_t kMultiplier = 0x9E3779B1U;  // Knuth: 2^32 over the golden ratio
  constexpr unsigned kShift = 26;
  static_assert(kPlaces == 1U << (32U - kShift));
  std::size_t place = (identity * kMultiplier) >> kShift;
  for (std::size_t n = 0; n < kPlaces && known_[place].index != kNoMessage; ++n) {
    if (known_[place].identity == identity) {
      return place;
    }
    place = (place + 1) % kPlaces;
  }
  return place;
}

/// Whether the CRC is that of any protected message of the bus.
bool MessageLinks::is_any_message(const CanFrame& frame) const {
  return fits_a_message_[e2e_fitting_signature(frame.data)];
}

/// From 1 on; it counts no further than it matters.
int MessageLinks::place_in_batch(std::size_t index, TimeUs now) {
  constexpr int kMostCounted = kMostAtOnce + kE2eWindowLimit + 1;
  Batch& batch = batch_[index];
  batch = {now, batch.now == now ? std::min(batch.frames + 1, kMostCounted) : 1};
  return batch.frames;
}

/// Only as many are noted as make a fault: more would push what else was wrong out of the window.
void MessageLinks::refuse_surplus(std::size_t index, int place, const CanFrame& frame, TimeUs now) {
  const unsigned bit = 1U << index;
  if (!rules_.rule[index].is_protected) {
    newest_[index] = frame.data;
    if ((has_newest_ & bit) == 0U) {
      has_newest_ |= bit;
      return;
    }
  } else if (place <= kMostAtOnce + kE2eWindowLimit) {
    e2e_note(window_[index], E2eMark::kSequence, now);
  }
  count(index, &LinkCounters::surplus);
}

int MessageLinks::take_newest(dbc::Payload& payload) {
  for (std::size_t i = 0; has_newest_ != 0U && i < kMostMessages; ++i) {
    const unsigned bit = 1U << i;
    if ((has_newest_ & bit) != 0U) {
      has_newest_ &= ~bit;
      payload = newest_[i];
      return static_cast<int>(i);
    }
  }
  return kNoMessage;
}

void MessageLinks::count(std::size_t index, std::uint32_t LinkCounters::*counter) {
  increment(link_[index].*counter);
  increment(total_.*counter);
}

/// Of a frame that was accepted; `before` is what was known of its message before it.
bool MessageLinks::is_fresh(std::size_t index, const E2eState& before, TimeUs now) {
  MessageClock& clock = clock_[index];
  if (!before.synchronised) {
    clock = {};
    return true;
  }
  const unsigned steps =
      (static_cast<unsigned>(e2e_[index].last_counter) + kE2eCounterCount - before.last_counter) %
      kE2eCounterCount;
  advance(clock, now - before.last_good_us, steps * rules_.rule[index].e2e.cycle_us);
  return !is_stale(clock);
}

bool MessageLinks::passes_e2e(std::size_t index, const CanFrame& frame, TimeUs now) {
  const E2eState before = e2e_[index];
  const E2eCheck check = e2e_check(rules_.rule[index].e2e, e2e_[index], frame.data, now);
  if (check == E2eCheck::kWrongCrc && is_any_message(frame)) {
    e2e_note(window_[index], E2eMark::kMasquerade, now);
    count(index, &LinkCounters::masquerade);
    return false;
  }
  if (check == E2eCheck::kWrongCrc) {
    e2e_note(window_[index], E2eMark::kCorrupt, now);
  } else if (check != E2eCheck::kRepeated) {
    e2e_note(window_[index], mark_of(check), now);
  }
  if (!e2e_accepted(check)) {
    count(index, counter_of(check));
    return false;
  }
  if (!is_fresh(index, before, now)) {
    count(index, &LinkCounters::wrong_counter);
    return false;
  }
  return true;
}

int MessageLinks::admit(const CanFrame& frame, TimeUs now) {
  if (frame.error) {
    increment(total_.wrong_kind);
    return kNoMessage;
  }
  const int index = index_of(frame.id);
  if (index == kNoMessage) {
    increment(foreign_);
    return kNoMessage;
  }
  if (index == kOwnMessage) {
    if (!frame.extended || frame.remote || frame.fd) {
      increment(total_.wrong_kind);
      return kNoMessage;
    }
    increment(total_.own_id);
    own_heard_ = true;
    own_us_ = now;
    return kNoMessage;
  }
  return admit_as(index, frame, now);
}

int MessageLinks::admit_as(int index, const CanFrame& frame, TimeUs now) {
  const auto i = static_cast<std::size_t>(index);
  const MessageRule& rule = rules_.rule[i];
  if (frame.error || frame.extended != rule.extended || frame.remote || frame.fd) {
    count(i, &LinkCounters::wrong_kind);
    return kNoMessage;
  }
  if (frame.length != rule.length) {
    count(i, &LinkCounters::wrong_length);
    return kNoMessage;
  }
  const int place = place_in_batch(i, now);
  if (place > kMostAtOnce) {
    refuse_surplus(i, place, frame, now);
    return kNoMessage;
  }
  return rule.is_protected && !passes_e2e(i, frame, now) ? kNoMessage : index;
}

void MessageLinks::note_decoded(int index, bool in_range) {
  count(static_cast<std::size_t>(index),
        in_range ? &LinkCounters::accepted : &LinkCounters::out_of_range);
  out_of_range_ = out_of_range_ || !in_range;
}

FaultSet MessageLinks::message_faults(TimeUs now) const {
  FaultSet faults;
  for (std::size_t i = 0; i < rules_.count; ++i) {
    faults.add(e2e_faults(window_[i], now));
    const bool is_heard =
        e2e_[i].any_good && now - e2e_[i].last_good_us <= rules_.rule[i].e2e.max_silence_us;
    if (is_stale(clock_[i]) && is_heard) {
      faults.add(Fault::kStreamLate);
    }
  }
  if (own_heard_ && now - own_us_ <= kOwnHeard_us) {
    faults.add(Fault::kSecondController);
  }
  return faults;
}

bool MessageLinks::take_out_of_range() {
  const bool was_out_of_range = out_of_range_;
  out_of_range_ = false;
  return was_out_of_range;
}

LinkCounters MessageLinks::link(std::uint32_t id) const {
  const int index = index_of(id);
  return index < 0 ? LinkCounters{} : link_[static_cast<std::size_t>(index)];
}

E2eCheck MessageLinks::link_check(std::uint32_t id, TimeUs now) const {
  const int index = index_of(id);
  if (index < 0) {
    return E2eCheck::kNoNewData;
  }
  const auto i = static_cast<std::size_t>(index);
  return e2e_status(rules_.rule[i].e2e, e2e_[i], now);
}

}  // namespace graben
