#include "hal/message_links.hpp"

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

int MessageLinks::index_of(std::uint32_t id) const {
  for (std::size_t i = 0; i < rules_.count; ++i) {
    if (rules_.rule[i].id == id && has_part(parts_, rules_.rule[i].part)) {
      return static_cast<int>(i);
    }
  }
  return kNoMessage;
}

/// Whether the CRC is that of any protected message of the bus.
bool MessageLinks::is_any_message(const CanFrame& frame) const {
  bool fits = false;
  for (std::size_t i = 0; i < rules_.all_count; ++i) {
    const dbc::MessageInfo& message = rules_.all[i];
    fits = fits || (message.is_protected && e2e_crc_fits(frame.data, message.data_id));
  }
  return fits;
}

void MessageLinks::count(std::size_t index, std::uint32_t LinkCounters::*counter) {
  increment(link_[index].*counter);
  increment(total_.*counter);
}

bool MessageLinks::passes_e2e(std::size_t index, const CanFrame& frame, TimeUs now) {
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
  const auto i = static_cast<std::size_t>(index);
  const MessageRule& rule = rules_.rule[i];
  if (!frame.extended || frame.remote || frame.fd) {
    count(i, &LinkCounters::wrong_kind);
    return kNoMessage;
  }
  if (frame.length != rule.length) {
    count(i, &LinkCounters::wrong_length);
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
  return index == kNoMessage ? LinkCounters{} : link_[static_cast<std::size_t>(index)];
}

E2eCheck MessageLinks::link_check(std::uint32_t id, TimeUs now) const {
  const int index = index_of(id);
  if (index == kNoMessage) {
    return E2eCheck::kNoNewData;
  }
  const auto i = static_cast<std::size_t>(index);
  return e2e_status(rules_.rule[i].e2e, e2e_[i], now);
}

}  // namespace graben
