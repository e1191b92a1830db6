// SPDX-License-Identifier: Apache-2.0
#include "app/ecu/store/fault_keeper.hpp"

#include <algorithm>
#include <cstdio>

namespace graben::ecu {
namespace {

constexpr TimeUs kSettlesUs = kSecondUs;  ///< What belongs together comes within it.
constexpr TimeUs kHistoryEveryUs = 5 * kSecondUs;
constexpr TimeUs kHoursEveryUs = 600 * kSecondUs;
constexpr TimeUs kRetryUs = 60 * kSecondUs;
constexpr int kHistoryReserve = 8;

std::uint32_t seconds(TimeUs us) { return static_cast<std::uint32_t>(us / kSecondUs); }

/// Since 1970, of what was `ago_us` before `unix_s`.
std::uint32_t wall_s(std::uint32_t unix_s, TimeUs ago_us) {
  return unix_s == 0 ? 0 : unix_s - seconds(std::max<TimeUs>(ago_us, 0));
}

}  // namespace

std::string FaultKeeper::begin(TimeUs now_us, std::uint32_t boot) {
  boot_ = boot;
  begin_us_ = now_us;
  FoundFaults found;
  if (store_.look() != Place::kNone) {
    find_faults(store_, found, frame_);
  }
  // Another machine's faults are none of this one's; what the disk has borne is the disk's.
  budget_.begin(found.is_whole ? found.history.tokens : kMostTokens, now_us);
  go_on_from(found.is_own() ? found.history : FaultHistory{});
  written_us_ = now_us;
  changed(now_us);
  return found_words(found, history_).data() + found.damaged_words();
}

void FaultKeeper::go_on_from(FaultHistory base) {
  known_[place_].base = base;
  if (boot_ == 0 || boot_ != base.boot) {
    ++base.power_cycles;
  }
  base.boot = boot_;
  begin_s_ = base.operation_s;
  lost_before_ = base.lost;
  history_ = own_;
  history_.follow(base, cleared_);
}

const FaultKeeper::Known* FaultKeeper::written_here(std::uint32_t checksum) const {
  const auto found = std::find_if(known_.begin(), known_.end(), [&](const Known& one) {
    return one.checksum[0] == checksum || one.checksum[1] == checksum;
  });
  return found == known_.end() ? nullptr : &*found;
}

void FaultKeeper::adopt(TimeUs now_us) {
  FoundFaults found;
  find_faults(store_, found, frame_);
  if (found.is_whole) {
    budget_.limit(found.history.tokens);
  }
  // On an empty one goes on what there was.
  FaultHistory base = known_[place_].base;
  if (found.is_own()) {
    // What was written here before has some of our own in it.
    const Known* const before = written_here(found.checksum);
    base = before != nullptr ? before->base : found.history;
    static_cast<void>(rings_.found.put(occurrences_of(base)));
  }
  place_ = (place_ + 1) % known_.size();
  known_[place_].checksum = {};
  go_on_from(base);
  granted_ = 0;
  changed(now_us);
  std::array<char, 320> line{};
  static_cast<void>(std::snprintf(line.data(), line.size(),
                                  "store: the disk is there now: %s; damaged files: %d",
                                  found_words(found, history_).data(), found.damaged()));
  say_(line.data());
}

Place FaultKeeper::reach(TimeUs now_us) {
  const Place place = store_.look();
  if (place == Place::kAnother) {
    adopt(now_us);
  } else if (place == Place::kNone) {
    history_failed(now_us);
  }
  return place;
}

std::uint32_t FaultKeeper::operation_s(TimeUs now_us) const {
  return begin_s_ + seconds(std::max<TimeUs>(now_us - begin_us_, 0));
}

void FaultKeeper::changed(TimeUs now_us) {
  changed_us_ = has_changed_ ? changed_us_ : now_us;
  has_changed_ = true;
}

void FaultKeeper::drain(TimeUs now_us, std::uint32_t unix_s) {
  while (const FaultEvent* const event = rings_.events.front()) {
    if (event->fault == Fault::kNone) {
      forget(*event);
    } else {
      const std::uint32_t came_s = wall_s(unix_s, now_us - event->now_us);
      history_.add(event->fault, operation_s(event->now_us), came_s);
      own_.add(event->fault, operation_s(event->now_us) - begin_s_, came_s);
    }
    rings_.events.take();
    changed(now_us);
  }
  while (const LearntRecord* const learnt = rings_.learnt.front()) {
    // Written with what is written anyway.
    if (learnt->count > 0) {
      history_.learnt = own_.learnt = *learnt;
    }
    rings_.learnt.take();
  }
  while (const std::uint32_t* const left = rings_.left_site.front()) {
    if (history_.left_site != *left) {
      changed(now_us);
    }
    history_.left_site = own_.left_site = *left;
    rings_.left_site.take();
  }
  while (const FreezeFrame* const frame = rings_.frames.front()) {
    if (!waiting_.take(*frame, now_us)) {
      ++frames_lost_;
    }
    rings_.frames.take();
  }
}

void FaultKeeper::forget(const FaultEvent& event) {
  const FaultSet& cleared = event.cleared;
  for (Fault fault = cleared.first(); fault != Fault::kNone; fault = cleared.after(fault)) {
    history_.of(fault) = {};
    own_.of(fault) = {};
    cleared_.add(fault);
  }
  waiting_.forget(cleared, event.now_us);
}

bool FaultKeeper::put(RecordKey key, std::size_t length) {
  const bool written = store_.write(key, payload_.data(), length);
  if (written) {
    ++writes_;
  }
  return written;
}

void FaultKeeper::say_failure(const char* what_follows) const {
  std::array<char, 320> line{};
  static_cast<void>(
      std::snprintf(line.data(), line.size(), "store: %s; %s", store_.error(), what_follows));
  say_(line.data());
}

void FaultKeeper::history_failed(TimeUs now_us) {
  ++failures_;
  history_fails_ = true;
  granted_ = 0;
  retry_us_ = now_us + kRetryUs;
  if (!has_said_) {
    has_said_ = true;
    say_failure("control goes on, nothing is stored; tried again each minute");
  }
}

void FaultKeeper::frame_failed(TimeUs now_us) {
  ++failures_;
  frame_fails_ = true;
  frame_retry_us_ = now_us + kRetryUs;
  if (!has_said_frame_) {
    has_said_frame_ = true;
    say_failure("a freeze frame waits, tried again each minute");
  }
}

void FaultKeeper::write_history_now(TimeUs now_us, bool is_last) {
  has_tried_ = true;
  written_us_ = now_us;
  if (reach(now_us) == Place::kNone) {
    return;
  }
  const int left = budget_.left(now_us);
  if (left == 0) {
    return;
  }
  const int wanted = now_us >= frame_retry_us_ || is_last ? waiting_.count() : 0;
  granted_ = std::clamp(wanted, 0, std::max(left - 1 - kHistoryReserve, 0));
  // Paid whether it is written or not: a disk that fails is not to be tried without end.
  budget_.take(1 + granted_);
  history_.tokens = static_cast<std::uint16_t>(left - 1 - granted_);
  history_.operation_s = operation_s(now_us);
  // Those that are not paid for at the end are never written.
  const int unpaid = is_last ? waiting_.count() - granted_ : 0;
  history_.lost = lost_before_ + dropped() + static_cast<std::uint32_t>(unpaid);
  const std::size_t length = write_history(history_, payload_.data());
  std::array<std::uint32_t, 2>& tried = known_[place_].checksum;
  tried = {crc32(payload_.data(), length), tried[0]};
  if (put(kHistoryKey, length)) {
    has_changed_ = false;
    history_fails_ = false;
  } else {
    history_failed(now_us);
  }
}

void FaultKeeper::write_next_frame(TimeUs now_us, std::uint32_t unix_s) {
  const WaitingFrames::Next next = waiting_.next();
  const FreezeFrame& from = *next.frame;
  frame_.fault = next.fault;
  frame_.kind = kind_;
  frame_.operation_s = operation_s(from.came_us);
  frame_.unix_s = wall_s(unix_s, now_us - from.came_us);
  frame_.count = from.count;
  for (std::size_t i = 0; i < from.count; ++i) {
    frame_.sample[i] = from.sample[i];
    frame_.sample[i].now_us -= from.came_us;
  }
  --granted_;
  if (put(frame_key(next.fault), write_frame(frame_, payload_.data()))) {
    waiting_.written(next.fault, now_us);
    frame_fails_ = false;
  } else {
    waiting_.put_off(next.fault);
    frame_failed(now_us);
  }
}

void FaultKeeper::work(TimeUs now_us, std::uint32_t unix_s) {
  drain(now_us, unix_s);
  const int frames = waiting_.count();
  frame_fails_ = frame_fails_ && frames > 0;
  if (granted_ > 0 && frames > 0 && now_us >= frame_retry_us_) {
    // Another disk is to have the history first.
    if (reach(now_us) == Place::kSame) {
      write_next_frame(now_us, unix_s);
    }
  } else if (now_us >= retry_us_) {
    const int left = budget_.left(now_us);
    const bool pays_frames = left > 1 + kHistoryReserve && frames > 0 && now_us >= frame_retry_us_;
    if (now_us - written_us_ >= kHoursEveryUs || pays_frames) {
      changed(now_us);
    }
    if (has_changed_ && now_us - changed_us_ >= kSettlesUs && left > 0 &&
        (!has_tried_ || now_us - written_us_ >= kHistoryEveryUs)) {
      write_history_now(now_us, false);
    }
  }
  is_failing_ = history_fails_ || frame_fails_;
}

void FaultKeeper::finish(TimeUs now_us, std::uint32_t unix_s) {
  drain(now_us, unix_s);
  if (budget_.left(now_us) == 0) {
    return;
  }
  write_history_now(now_us, true);
  // Each that it has paid for once, however the one before went.
  while (granted_ > 0 && waiting_.count() > 0) {
    write_next_frame(now_us, unix_s);
  }
  is_failing_ = history_fails_ || frame_fails_;
  if (waiting_.count() > 0) {
    frames_lost_ += static_cast<std::uint32_t>(waiting_.count());
    std::array<char, 80> line{};
    static_cast<void>(std::snprintf(
        line.data(), line.size(), "store: freeze frames lost with the end: %d", waiting_.count()));
    say_(line.data());
  }
}

}  // namespace graben::ecu
