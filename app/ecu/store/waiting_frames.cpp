// SPDX-License-Identifier: Apache-2.0
#include "app/ecu/store/waiting_frames.hpp"

#include <algorithm>

namespace graben::ecu {
namespace {

constexpr TimeUs kFrameEveryUs = 600 * kSecondUs;

std::size_t at(Fault fault) { return static_cast<std::size_t>(fault); }

}  // namespace

bool WaitingFrames::take(const FreezeFrame& frame, TimeUs now_us) {
  FaultSet wanted;
  for (Fault fault = frame.faults.first(); fault != Fault::kNone;
       fault = frame.faults.after(fault)) {
    const bool is_recent = written_.has(fault) && now_us - written_us_[at(fault)] < kFrameEveryUs;
    const bool is_cleared = cleared_.has(fault) && frame.came_us <= cleared_us_[at(fault)];
    if (!is_recent && !is_cleared && !waiting_.has(fault)) {
      wanted.add(fault);
    }
  }
  if (wanted.empty()) {
    return true;
  }
  if (count_ == kMostFrames) {
    return false;
  }
  frame_[count_] = frame;
  frame_[count_].faults = wanted;
  ++count_;
  waiting_.add(wanted);
  return true;
}

void WaitingFrames::forget(const FaultSet& cleared, TimeUs at_us) {
  for (Fault fault = cleared.first(); fault != Fault::kNone; fault = cleared.after(fault)) {
    written_.remove(fault);
    cleared_.add(fault);
    cleared_us_[at(fault)] = at_us;
    remove(fault);
  }
}

WaitingFrames::Next WaitingFrames::next() {
  for (std::size_t i = 0; i < count_; ++i) {
    const FaultSet& faults = frame_[i].faults;
    for (Fault fault = faults.first(); fault != Fault::kNone; fault = faults.after(fault)) {
      if (!put_off_.has(fault)) {
        return {&frame_[i], fault};
      }
    }
  }
  put_off_ = {};
  return {&frame_[0], frame_[0].faults.first()};
}

void WaitingFrames::written(Fault fault, TimeUs now_us) {
  written_.add(fault);
  written_us_[at(fault)] = now_us;
  remove(fault);
}

void WaitingFrames::remove(Fault fault) {
  waiting_.remove(fault);
  put_off_.remove(fault);
  for (std::size_t i = 0; i < count_; ++i) {
    frame_[i].faults.remove(fault);
  }
  const auto end = frame_.begin() + static_cast<std::ptrdiff_t>(count_);
  count_ = static_cast<std::size_t>(
      std::remove_if(frame_.begin(), end,
                     [](const FreezeFrame& frame) { return frame.faults.empty(); }) -
      frame_.begin());
}

}  // namespace graben::ecu
