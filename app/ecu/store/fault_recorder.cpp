// SPDX-License-Identifier: Apache-2.0
#include "app/ecu/store/fault_recorder.hpp"

#include <algorithm>

namespace graben::ecu {
namespace {
constexpr TimeUs kPowerOnUs = 10 * kSecondUs;
constexpr std::uint32_t kMostOccurrences = 126;

std::uint8_t limited(std::uint32_t occurrences) {
  return static_cast<std::uint8_t>(std::min(occurrences, kMostOccurrences));
}
}  // namespace

Occurrences occurrences_of(const FaultHistory& history) {
  Occurrences all{};
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i] = limited(history.entry[i].occurrences);
  }
  return all;
}

void FaultRecorder::begin(const FaultHistory& history) { go_on_from(occurrences_of(history)); }

void FaultRecorder::go_on_from(const Occurrences& found) {
  for (int number = 1; number < kFaultCount; ++number) {
    const auto i = static_cast<std::size_t>(number);
    const bool counts = !cleared_.has(static_cast<Fault>(number));
    stored_[i] = limited(own_[i] + (counts ? std::uint32_t{found[i]} : 0U));
  }
}

void FaultRecorder::forget(const FaultSet& cleared, TimeUs now_us) {
  if (cleared.empty()) {
    return;
  }
  for (Fault fault = cleared.first(); fault != Fault::kNone; fault = cleared.after(fault)) {
    stored_[static_cast<std::size_t>(fault)] = 0;
    own_[static_cast<std::size_t>(fault)] = 0;
    cleared_.add(fault);
    // A frame that is not whole yet is forgotten with it.
    waiting_.remove(fault);
    if (last_.fault == fault) {
      last_.fault = Fault::kNone;
    }
  }
  if (rings_ != nullptr) {
    static_cast<void>(rings_->events.put({Fault::kNone, now_us, cleared}));
  }
}

void FaultRecorder::keep(const CycleSample& sample) {
  if (--until_sample_ > 0) {
    return;
  }
  until_sample_ = kSampleEvery;
  kept_[next_] = sample;
  next_ = (next_ + 1) % kFrameSamples;
  count_ = count_ < kFrameSamples ? count_ + 1 : count_;
}

void FaultRecorder::note(const FaultSet& faults, const CycleSample& sample) {
  const TimeUs now_us = sample.now_us;
  for (Fault fault = faults.first(); fault != Fault::kNone; fault = faults.after(fault)) {
    if (there_.has(fault)) {
      continue;
    }
    const auto i = static_cast<std::size_t>(fault);
    stored_[i] = limited(stored_[i] + 1U);
    own_[i] = limited(own_[i] + 1U);
    // Of several in one cycle the one of the lowest number.
    if (last_.fault == Fault::kNone || last_.sample.now_us != now_us) {
      last_ = {fault, sample};
    }
    if (rings_ == nullptr) {
      continue;
    }
    static_cast<void>(rings_->events.put({fault, now_us, {}}));
    // One that goes and comes within its own frame is in that.
    if (!waiting_.has(fault)) {
      waiting_.add(fault);
      came_us_[static_cast<std::size_t>(fault)] = now_us;
    }
  }
  there_ = faults;
}

void FaultRecorder::hand_over_due(TimeUs now_us) {
  FaultSet due;
  TimeUs came_us = now_us;
  for (Fault fault = waiting_.first(); fault != Fault::kNone; fault = waiting_.after(fault)) {
    const TimeUs since_us = came_us_[static_cast<std::size_t>(fault)];
    if (now_us - since_us >= kFrameAfterUs) {
      due.add(fault);
      came_us = since_us < came_us ? since_us : came_us;
    }
  }
  if (due.empty()) {
    return;
  }
  for (Fault fault = due.first(); fault != Fault::kNone; fault = due.after(fault)) {
    waiting_.remove(fault);
  }
  FreezeFrame* const frame = rings_->frames.place();
  if (frame == nullptr) {
    return;
  }
  frame->faults = due;
  frame->came_us = came_us;
  frame->count = count_;
  const std::size_t oldest = count_ < kFrameSamples ? 0 : next_;
  for (std::size_t i = 0; i < count_; ++i) {
    frame->sample[i] = kept_[(oldest + i) % kFrameSamples];
  }
  rings_->frames.put();
}

void FaultRecorder::look(const CycleSample& sample, const FaultSet& faults) {
  if (!has_started_) {
    has_started_ = true;
    start_us_ = sample.now_us;
  }
  if (const Occurrences* const found = rings_ == nullptr ? nullptr : rings_->found.front()) {
    go_on_from(*found);
    rings_->found.take();
  }
  keep(sample);
  counts_ = counts_ || sample.mode != EcuMode::kSilent || sample.now_us - start_us_ >= kPowerOnUs;
  if (sample.mode == EcuMode::kStopping) {
    return;
  }
  if (counts_) {
    note(faults, sample);
  }
  if (!waiting_.empty()) {
    hand_over_due(sample.now_us);
  }
}

}  // namespace graben::ecu
