// SPDX-License-Identifier: Apache-2.0
#include "hal/j1939/diagnostics.hpp"

#include <algorithm>

#include "firmware/safety/mode.hpp"
#include "hal/j1939/ids.hpp"
#include "hal/link/dm1.hpp"

namespace graben::j1939 {
namespace {

constexpr std::uint8_t kDone = 0;
constexpr std::uint8_t kRefused = 1;
constexpr std::uint8_t kCannotNow = 3;
constexpr std::uint8_t kNoValue = 0xFF;
constexpr std::size_t kRequestBytes = 3;
constexpr TimeUs kSlackUs = 5 * kMillisecondUs;
constexpr TimeUs kTransportGapUs = 60 * kMillisecondUs - kSlackUs;
/// After a DM1 by BAM has begun another one may begin until then, or right after its end: both, of
/// 17 codes each, let the next DM1 end 1.35 s after the last one.
constexpr TimeUs kOthersWithinUs = 640 * kMillisecondUs;
constexpr TimeUs kRightAfterUs = 20 * kMillisecondUs;
/// A tool has given up by then (J1939-21 has 1.25 s).
constexpr TimeUs kMostWaitUs = 1250 * kMillisecondUs;
/// A request that could not even be refused by then.
constexpr TimeUs kStaleUs = kMostWaitUs + 100 * kMillisecondUs;
/// A tool waits 750 ms for a packet (T1). A broadcast's, which may be 200 ms apart, makes room.
constexpr TimeUs kConnectionWaitsUs = 480 * kMillisecondUs;

FaultSet stored_and(bool are_active, const DiagnosticState& state) {
  FaultSet set;
  for (int number = 1; number < kFaultCount; ++number) {
    const auto fault = static_cast<Fault>(number);
    const bool is_stored = state.stored[static_cast<std::size_t>(number)] > 0;
    if (is_stored && state.active.has(fault) == are_active) {
      set.add(fault);
    }
  }
  return set;
}

CanFrame frame_of(const LongMessage& message, std::uint8_t own, TimeUs now) {
  CanFrame frame;
  frame.id = id_of(kDiagnosticPriority, message.pgn, kGlobalAddress, own);
  frame.length = 8;
  frame.stamp_us = now;
  std::copy_n(message.bytes.begin(), frame.data.size(), frame.data.begin());
  return frame;
}

void put(DiagnosticWork& work, const CanFrame& frame) {
  if (work.count < DiagnosticWork::kMostFrames) {
    work.frame[work.count++] = frame;
  }
}

}  // namespace

Diagnostics::Diagnostics(std::uint8_t own_address, const std::uint32_t* ids, std::size_t count)
    : own_(own_address), ids_(ids), id_count_(count), bam_(own_address), connection_(own_address) {}

void Diagnostics::hear(const CanFrame& frame, TimeUs now) {
  if (!frame.extended || frame.remote || frame.error || frame.fd) {
    return;
  }
  const Address from = address_of(frame.id);
  const bool is_ours = from.receiver == own_ || from.receiver == kGlobalAddress;
  // Who has our address, or none, gets no answer.
  if (!is_ours || from.sender == own_ || from.sender >= kNullAddress) {
    return;
  }
  if (from.pgn == kConnectionPgn && from.receiver == own_ && frame.length == 8) {
    connection_.hear(frame, now);
  }
  if (from.pgn != kRequestPgn || frame.length < kRequestBytes || frame.length > 8) {
    return;
  }
  const Request request = {frame.data[0] | static_cast<std::uint32_t>(frame.data[1]) << 8U |
                               static_cast<std::uint32_t>(frame.data[2]) << 16U,
                           from.sender, from.receiver == kGlobalAddress, now};
  if (request.pgn == kAddressClaimedPgn) {
    return;  // answered by AddressClaim
  }
  for (std::size_t i = 0; i < requests_; ++i) {
    if (request_[i].pgn == request.pgn && request_[i].sender == request.sender &&
        request_[i].to_all == request.to_all) {
      return;
    }
  }
  if (requests_ == kMostRequests) {
    dropped_ += dropped_ < UINT32_MAX ? 1U : 0U;
    return;
  }
  request_[requests_++] = request;
}

bool Diagnostics::holds(const CanFrame& frame) {
  if (!same_message(frame.id, id_of(kDiagnosticPriority, kActiveCodesPgn, kGlobalAddress, own_))) {
    return false;
  }
  held_ = frame;
  has_held_ = true;
  return true;
}

void Diagnostics::count_active(const FaultSet& active) {
  for (Fault fault = active.first(); fault != Fault::kNone; fault = active.after(fault)) {
    std::uint8_t& count = since_start_[static_cast<std::size_t>(fault)];
    count = static_cast<std::uint8_t>(count +
                                      (active_.has(fault) || count == kDm1MaxOccurrences ? 0 : 1));
  }
  active_ = active;
}

LongMessage Diagnostics::codes(std::uint32_t pgn, const DiagnosticState& state) const {
  if (pgn == kSupportPgn) {
    return supported_parameters();
  }
  if (pgn == kFreezeFramePgn) {
    return freeze_frame(state.sample, state.stored);
  }
  return pgn == kActiveCodesPgn
             ? trouble_codes(pgn, state.active, state.active, since_start_)
             : trouble_codes(pgn, stored_and(false, state), state.active, state.stored);
}

bool Diagnostics::has_news(const FaultSet& active, TimeUs now) const {
  bool any = false;
  for (int number = 1; number < kFaultCount; ++number) {
    const auto fault = static_cast<Fault>(number);
    const TimeUs last_us = news_us_[static_cast<std::size_t>(number)];
    const bool is_allowed = last_us == 0 || now < last_us || now - last_us >= kSecondUs - kSlackUs;
    any = any || (active.has(fault) != said_.has(fault) && is_allowed);
  }
  return any;
}

void Diagnostics::begin_active(const DiagnosticState& state, TimeUs now) {
  bam_.begin(codes(kActiveCodesPgn, state));
  for (int number = 1; number < kFaultCount; ++number) {
    const auto fault = static_cast<Fault>(number);
    if (state.active.has(fault) != said_.has(fault)) {
      news_us_[static_cast<std::size_t>(number)] = now;
    }
  }
  said_ = state.active;
  said_us_ = now;
  has_said_ = true;
}

void Diagnostics::send_active(const DiagnosticState& state, TimeUs now, DiagnosticWork& work) {
  const bool are_several = count_of(state.active) > 1;
  const bool is_saying = bam_.is_busy() && bam_.pgn() == kActiveCodesPgn;
  if (!are_several) {
    owes_single_ = owes_single_ || has_said_;
    has_said_ = false;
    if ((has_held_ || owes_single_) && !is_saying) {
      put(work, owes_single_ ? frame_of(codes(kActiveCodesPgn, state), own_, now) : held_);
      has_held_ = false;
      owes_single_ = false;
    }
    return;
  }
  has_held_ = false;
  owes_single_ = false;
  const bool is_due = !has_said_ || now < said_us_ || now - said_us_ >= kSecondUs - kSlackUs ||
                      has_news(state.active, now);
  if (is_due && !bam_.is_busy()) {
    begin_active(state, now);
  }
}

void Diagnostics::acknowledge(std::uint8_t control, const Request& request, TimeUs now,
                              DiagnosticWork& work) {
  if (request.to_all) {
    return;
  }
  CanFrame frame;
  frame.id = id_of(kDiagnosticPriority, kAcknowledgmentPgn, kGlobalAddress, own_);
  frame.length = 8;
  frame.stamp_us = now;
  frame.data = {control,
                kNoValue,
                kNoValue,
                kNoValue,
                request.sender,
                static_cast<std::uint8_t>(request.pgn),
                static_cast<std::uint8_t>(request.pgn >> 8U),
                static_cast<std::uint8_t>(request.pgn >> 16U)};
  put(work, frame);
}

void Diagnostics::clear(const Request& request, const DiagnosticState& state, TimeUs now,
                        DiagnosticWork& work) {
  if (in_motion(state.mode)) {
    acknowledge(kRefused, request, now, work);
    return;
  }
  if (!state.can_clear) {
    acknowledge(kCannotNow, request, now, work);
    return;
  }
  work.cleared = stored_and(request.pgn == kClearActivePgn, state);
  acknowledge(kDone, request, now, work);
}

bool Diagnostics::answer_codes(const Request& request, const DiagnosticState& state, TimeUs now,
                               DiagnosticWork& work) {
  const LongMessage message = codes(request.pgn, state);
  if (message.size <= 8) {
    put(work, frame_of(message, own_, now));
    return true;
  }
  // What is asked of all must not keep DM1 from its second.
  const bool is_late =
      has_said_ && now - said_us_ > kOthersWithinUs && now - active_done_us_ > kRightAfterUs;
  const bool is_busy =
      request.to_all ? bam_.is_busy() || connection_.is_busy() || is_late : connection_.is_busy();
  if (!is_busy && request.to_all) {
    bam_.begin(message);
  } else if (!is_busy) {
    connection_.begin(message, request.sender);
  } else if (now - request.since_us < kMostWaitUs) {
    return false;
  } else {
    acknowledge(kCannotNow, request, now, work);
  }
  return true;
}

bool Diagnostics::is_sent_by_itself(std::uint32_t pgn) const {
  return !std::none_of(ids_, ids_ + id_count_,
                       [&](std::uint32_t id) { return address_of(id).pgn == pgn; });
}

bool Diagnostics::answer_one(const Request& request, const DiagnosticState& state, TimeUs now,
                             DiagnosticWork& work) {
  switch (request.pgn) {
    case kActiveCodesPgn:
    case kPreviousCodesPgn:
    case kSupportPgn:
    case kFreezeFramePgn:
      return answer_codes(request, state, now, work);
    case kClearPreviousPgn:
    case kClearActivePgn:
      clear(request, state, now, work);
      return true;
    default:
      if (!is_sent_by_itself(request.pgn)) {
        acknowledge(kRefused, request, now, work);
      }
      return true;
  }
}

bool Diagnostics::may_answer(TimeUs now) const {
  const TimeUs fifth_us = answered_us_[answers_ % kAnswersASecond];
  return answers_ < kAnswersASecond || now < fifth_us || now - fifth_us >= kSecondUs;
}

void Diagnostics::drop_request(std::size_t at) {
  for (std::size_t next = at + 1; next < requests_; ++next) {
    request_[next - 1] = request_[next];
  }
  --requests_;
}

void Diagnostics::answer(const DiagnosticState& state, TimeUs now, DiagnosticWork& work) {
  // One that nobody waits for any more; they stand in the order in which they came.
  if (requests_ > 0 && now - request_[0].since_us > kStaleUs) {
    drop_request(0);
    dropped_ += dropped_ < UINT32_MAX ? 1U : 0U;
  }
  for (std::size_t i = 0; i < requests_ && may_answer(now); ++i) {
    // One that has to wait for a transport keeps no other one waiting.
    if (answer_one(request_[i], state, now, work)) {
      drop_request(i);
      answered_us_[answers_++ % kAnswersASecond] = now;
      return;
    }
  }
}

bool Diagnostics::next_of_transport(TimeUs now, CanFrame& frame) {
  if (now >= transport_us_ && now - transport_us_ < kTransportGapUs) {
    return false;
  }
  const bool was_busy = bam_.is_busy();
  const bool tool_waits = was_busy && connection_.is_busy() &&
                          (now < connection_us_ || now - connection_us_ >= kConnectionWaitsUs);
  bool is_to_tool = tool_waits && connection_.due(now, frame);
  if (!is_to_tool && !bam_.due(now, frame)) {
    is_to_tool = !bam_.is_busy() && connection_.due(now, frame);
    if (!is_to_tool) {
      return false;
    }
  }
  transport_us_ = now;
  connection_us_ = is_to_tool ? now : connection_us_;
  if (was_busy && !bam_.is_busy() && bam_.pgn() == kActiveCodesPgn) {
    active_done_us_ = now;
  }
  return true;
}

DiagnosticWork Diagnostics::step(const DiagnosticState& state, TimeUs now) {
  DiagnosticWork work;
  count_active(state.active);
  send_active(state, now, work);
  answer(state, now, work);
  CanFrame frame;
  if (next_of_transport(now, frame)) {
    put(work, frame);
  }
  return work;
}

}  // namespace graben::j1939
