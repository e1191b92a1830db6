// SPDX-License-Identifier: Apache-2.0
#include "app/ecu/store/fault_keeper.hpp"

#include <algorithm>
#include <cstdio>

namespace graben::ecu {
namespace {

constexpr RecordKey kHistoryKey{RecordKind::kFaults, 0};
constexpr TimeUs kSettlesUs = kSecondUs;  ///< What belongs together comes within it.
constexpr TimeUs kHistoryEveryUs = 5 * kSecondUs;
constexpr TimeUs kHoursEveryUs = 600 * kSecondUs;
constexpr TimeUs kFrameEveryUs = 600 * kSecondUs;
constexpr TimeUs kRetryUs = 60 * kSecondUs;
constexpr int kHistoryReserve = 8;

RecordKey frame_key(Fault fault) {
  return {RecordKind::kFreezeFrame, static_cast<std::uint16_t>(fault)};
}

const char* state_words(ReadState state) {
  switch (state) {
    case ReadState::kRead:
      return "read";
    case ReadState::kNothing:
      return "new, nothing was there";
    case ReadState::kOtherProfile:
      return "new, what was there is of another profile";
    case ReadState::kOtherVersion:
      return "new, what was there is of another format";
    case ReadState::kDamaged:
      break;
  }
  return "new, what was there is damaged";
}

/// Bytes that are whole and say nothing.
ReadState worst(ReadState state) {
  return state == ReadState::kRead || state == ReadState::kOtherProfile ? ReadState::kDamaged
                                                                        : state;
}

/// Files that are not as they should be.
class ReadNote {
 public:
  void see(RecordKey key, const Store::Read& read) {
    for (unsigned copy = 0; copy < read.is_damaged.size(); ++copy) {
      if (read.is_damaged[copy]) {
        damaged_ += (damaged_.empty() ? "" : ", ") + std::string(file_name(key, copy).data());
        damaged_ += read.payload != nullptr ? " (the other copy counts)" : "";
      }
    }
    const bool is_foreign = read.state == ReadState::kOtherProfile;
    foreign_ += is_foreign && key.kind == RecordKind::kFreezeFrame ? 1 : 0;
  }
  [[nodiscard]] std::string words() const {
    return (foreign_ == 0 ? ""
                          : "; freeze frames of another profile: " + std::to_string(foreign_)) +
           (damaged_.empty() ? "" : "; damaged: " + damaged_);
  }

 private:
  std::string damaged_;
  int foreign_ = 0;
};

std::uint32_t seconds(TimeUs us) { return static_cast<std::uint32_t>(us / kSecondUs); }

/// Since 1970, of what was `ago_us` before `unix_s`.
std::uint32_t wall_s(std::uint32_t unix_s, TimeUs ago_us) {
  return unix_s == 0 ? 0 : unix_s - seconds(std::max<TimeUs>(ago_us, 0));
}

}  // namespace

std::string FaultKeeper::begin(TimeUs now_us, std::uint32_t boot) {
  ReadNote note;
  const Store::Read read = store_.read(kHistoryKey);
  note.see(kHistoryKey, read);
  FaultHistory found;
  const bool whole = read.payload != nullptr && read_history(read.payload, read.length, found);
  // Another machine's faults are none of this one's; what the disk has borne is the disk's.
  budget_.begin(whole ? found.tokens : kMostTokens, now_us);
  if (whole && read.state == ReadState::kRead) {
    history_ = found;
  }
  int frames = 0;
  for (int number = 1; number < kFaultCount; ++number) {
    const RecordKey key = frame_key(static_cast<Fault>(number));
    const Store::Read frame = store_.read(key);
    note.see(key, frame);
    frames += frame.state == ReadState::kRead ? 1 : 0;
  }
  begin_us_ = now_us;
  begin_s_ = history_.operation_s;
  lost_before_ = history_.lost;
  if (boot == 0 || boot != history_.boot) {
    ++history_.power_cycles;
  }
  history_.boot = boot;
  written_us_ = now_us;
  changed(now_us);
  std::array<char, 160> line{};
  static_cast<void>(
      std::snprintf(line.data(), line.size(),
                    "%s; power cycle %u, %u h of operation, faults stored: %d, freeze frames: %d",
                    state_words(whole ? read.state : worst(read.state)), history_.power_cycles,
                    history_.operation_s / 3600U, history_.stored(), frames));
  return line.data() + note.words();
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
      forget(event->cleared);
    } else {
      history_.add(event->fault, operation_s(event->now_us),
                   wall_s(unix_s, now_us - event->now_us));
    }
    rings_.events.take();
    changed(now_us);
  }
}

void FaultKeeper::forget(const FaultSet& cleared) {
  for (Fault fault = cleared.first(); fault != Fault::kNone; fault = cleared.after(fault)) {
    history_.of(fault) = {};
    framed_.remove(fault);
  }
}

int FaultKeeper::frames_wanted(TimeUs now_us) {
  while (const FreezeFrame* const frame = rings_.frames.front()) {
    int wanted = 0;
    const FaultSet& faults = frame->faults;
    for (Fault fault = faults.first(); fault != Fault::kNone; fault = faults.after(fault)) {
      const bool is_recent = framed_.has(fault) &&
                             now_us - framed_us_[static_cast<std::size_t>(fault)] < kFrameEveryUs;
      wanted += is_recent || of_front_.has(fault) ? 0 : 1;
    }
    if (wanted > 0) {
      return wanted;
    }
    rings_.frames.take();
    of_front_ = {};
  }
  return 0;
}

bool FaultKeeper::put(RecordKey key, std::size_t length) {
  const bool written = store_.write(key, payload_.data(), length);
  is_failing_ = !written;
  if (written) {
    ++writes_;
    return true;
  }
  ++failures_;
  if (!has_said_) {
    has_said_ = true;
    std::array<char, 320> line{};
    static_cast<void>(std::snprintf(line.data(), line.size(),
                                    "store: %s; control goes on, nothing is stored; tried again "
                                    "each minute",
                                    store_.error()));
    say_(line.data());
  }
  return false;
}

void FaultKeeper::write_history_now(TimeUs now_us) {
  const int left = budget_.left(now_us);
  granted_ = std::clamp(frames_wanted(now_us), 0, std::max(left - 1 - kHistoryReserve, 0));
  // Paid whether it is written or not: a disk that fails is not to be tried without end.
  budget_.take(1 + granted_);
  history_.tokens = static_cast<std::uint16_t>(left - 1 - granted_);
  history_.operation_s = operation_s(now_us);
  history_.lost = lost_before_ + dropped();
  has_tried_ = true;
  written_us_ = now_us;
  if (put(kHistoryKey, write_history(history_, payload_.data()))) {
    has_changed_ = false;
  } else {
    granted_ = 0;
    retry_us_ = now_us + kRetryUs;
  }
}

bool FaultKeeper::write_next_frame(TimeUs now_us, std::uint32_t unix_s) {
  if (granted_ == 0 || frames_wanted(now_us) == 0) {
    return false;
  }
  const FreezeFrame& from = *rings_.frames.front();
  Fault fault = from.faults.first();
  while (of_front_.has(fault) ||
         (framed_.has(fault) &&
          now_us - framed_us_[static_cast<std::size_t>(fault)] < kFrameEveryUs)) {
    fault = from.faults.after(fault);
  }
  frame_.fault = fault;
  frame_.kind = kind_;
  frame_.operation_s = operation_s(from.came_us);
  frame_.unix_s = wall_s(unix_s, now_us - from.came_us);
  frame_.count = from.count;
  for (std::size_t i = 0; i < from.count; ++i) {
    frame_.sample[i] = from.sample[i];
    frame_.sample[i].now_us -= from.came_us;
  }
  --granted_;
  of_front_.add(fault);
  if (put(frame_key(fault), write_frame(frame_, payload_.data()))) {
    framed_.add(fault);
    framed_us_[static_cast<std::size_t>(fault)] = now_us;
  } else {
    retry_us_ = now_us + kRetryUs;
  }
  return true;
}

void FaultKeeper::work(TimeUs now_us, std::uint32_t unix_s) {
  drain(now_us, unix_s);
  if (now_us < retry_us_ || write_next_frame(now_us, unix_s)) {
    return;
  }
  const int left = budget_.left(now_us);
  const bool pays_frames = left > 1 + kHistoryReserve && frames_wanted(now_us) > 0;
  if (now_us - written_us_ >= kHoursEveryUs || pays_frames) {
    changed(now_us);
  }
  if (has_changed_ && now_us - changed_us_ >= kSettlesUs && left > 0 &&
      (!has_tried_ || now_us - written_us_ >= kHistoryEveryUs)) {
    write_history_now(now_us);
  }
}

void FaultKeeper::finish(TimeUs now_us, std::uint32_t unix_s) {
  drain(now_us, unix_s);
  if (is_failing_ || budget_.left(now_us) == 0) {
    return;
  }
  write_history_now(now_us);
  while (write_next_frame(now_us, unix_s) && !is_failing_) {
  }
}

}  // namespace graben::ecu
