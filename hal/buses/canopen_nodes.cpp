// SPDX-License-Identifier: Apache-2.0
#include "hal/buses/canopen_nodes.hpp"

namespace graben {
namespace {

constexpr std::uint8_t kBootUp = 0x00;
constexpr std::uint8_t kStopped = 0x04;
constexpr std::uint8_t kOperational = 0x05;
constexpr std::uint8_t kPreOperational = 0x7F;
constexpr unsigned kEmergencyLength = 8;

bool is_of(const TableNode& node, std::uint32_t service, const CanFrame& frame) {
  return frame.id == service + node.id &&
         (node.bus == kAnyBus || frame.bus == kAnyBus || node.bus == frame.bus);
}

bool is_whole(const CanFrame& frame, unsigned length) {
  return !frame.remote && !frame.fd && frame.length == length;
}

}  // namespace

void CanopenNodes::take_heartbeat(const CanFrame& frame, TimeUs now, State& state) {
  const std::uint8_t said = frame.data[0];
  const bool whole = is_whole(frame, 1);
  if (whole && said == kOperational) {
    state.operational = true;
    state.waits = false;
    state.heard_us = now;
  } else if (whole && (said == kBootUp || said == kStopped || said == kPreOperational)) {
    state.operational = false;
    state.told = state.told && state.waits;
    state.waits = true;
    // What is still wrong it tells again.
    state.emergency = said == kBootUp ? std::uint16_t{0} : state.emergency;
  }
}

bool CanopenNodes::take(const CanFrame& frame, TimeUs now) {
  if (frame.extended || frame.error) {
    return false;
  }
  for (std::size_t i = 0; i < table_->node_count; ++i) {
    if (is_of(table_->node[i], kHeartbeatId, frame)) {
      take_heartbeat(frame, now, state_[i]);
      return true;
    }
    if (is_of(table_->node[i], kEmergencyId, frame)) {
      if (is_whole(frame, kEmergencyLength)) {
        const unsigned high = frame.data[1];
        state_[i].emergency = static_cast<std::uint16_t>(high << 8U | frame.data[0]);
      }
      return true;
    }
  }
  return false;
}

NodeEmergency CanopenNodes::emergency() const {
  for (std::size_t i = 0; i < table_->node_count; ++i) {
    if (state_[i].emergency != 0) {
      return {table_->node[i].id, state_[i].emergency};
    }
  }
  return {};
}

void CanopenNodes::finish(TimeUs now) {
  for (std::size_t i = 0; i < table_->node_count; ++i) {
    State& state = state_[i];
    state.operational = state.operational && now - state.heard_us <= table_->node[i].timeout_us;
  }
}

NodeStart CanopenNodes::take_start(TimeUs now) {
  for (std::size_t i = 0; i < table_->node_count; ++i) {
    State& state = state_[i];
    if (state.waits && !(state.told && now - state.told_us < kAgain_us)) {
      state.told = true;
      state.told_us = now;
      return {table_->node[i].id, table_->node[i].bus};
    }
  }
  return {};
}

}  // namespace graben
