// SPDX-License-Identifier: Apache-2.0
#include "platform/loopback/loopback_bus.hpp"

namespace graben {

bool LoopbackPort::on_bus() const {
  return state_ == CanPortState::kActive || state_ == CanPortState::kErrorPassive;
}

bool LoopbackPort::open() {
  if (state_ == CanPortState::kDown) {
    return false;
  }
  queue_.clear();
  state_ = CanPortState::kActive;
  return true;
}

int LoopbackPort::receive(CanFrame* frames, int capacity) {
  int count = 0;
  while (count < capacity && on_bus() && !queue_.empty()) {
    frames[count++] = queue_.front();
    queue_.pop_front();
  }
  return count;
}

bool LoopbackPort::send(const CanFrame& frame) {
  if (!on_bus() || send_fails_ || bus_.loses_arbitration(frame)) {
    return false;
  }
  bus_.transmit(frame, this);
  return true;
}

void LoopbackPort::deliver(const CanFrame& frame) {
  if (!on_bus()) {
    return;
  }
  if (queue_.size() >= queue_capacity_) {
    ++overflow_count_;
    return;
  }
  queue_.push_back(frame);
}

LoopbackPort& LoopbackBus::attach(std::size_t queue_capacity) {
  ports_.push_back(std::make_unique<LoopbackPort>(*this, queue_capacity));
  return *ports_.back();
}

bool LoopbackBus::loses_arbitration(const CanFrame& frame) const {
  // An 11-bit id is arbitrated as the top bits of a 29-bit one.
  constexpr unsigned kLowBits = 18;
  const std::uint32_t id = frame.extended ? frame.id : frame.id << kLowBits;
  return babble_id_ && id > *babble_id_;
}

void LoopbackBus::transmit(CanFrame frame, const LoopbackPort* from) {
  frame.stamp_us = now_;
  if (fault_hook_ && !fault_hook_(frame, from)) {
    return;
  }
  if (tap_) {
    tap_(frame);
  }
  for (const std::unique_ptr<LoopbackPort>& port : ports_) {
    if (port.get() != from) {
      port->deliver(frame);
    }
  }
}

}  // namespace graben
