// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Nodes of CANopen that a bus table names: which of them are operational, and which have to be
/// started (CiA 301: NMT, boot-up, heartbeat), and which of them have an emergency. Nothing more of
/// that protocol is spoken: what a node sends, how often and in which units has been set in it
/// before.
///
///   heartbeat 700h + id, one byte    05 operational: its messages count
///                                    00 boot-up, 7F pre-operational, 04 stopped: they don't, and
///                                    it is told to start, again every 100 ms until it has
///   silent for its time-out          they don't
///   emergency 080h + id, 8 bytes     bytes 0 and 1 are its code, low byte first: but for 0 they
///                                    don't, and are errors, until code 0 comes or it boots
///   NMT 000h, two bytes              01 and the node's id: start

#include <array>
#include <cstddef>
#include <cstdint>

#include "hal/buses/bus_table.hpp"
#include "hal/can_frame.hpp"

namespace graben {

class CanopenNodes {
 public:
  static constexpr std::uint32_t kHeartbeatId = 0x700;
  static constexpr std::uint32_t kEmergencyId = 0x080;
  static constexpr TimeUs kAgain_us = 100 * kMillisecondUs;

  /// Null: there is none. The table outlives it.
  explicit CanopenNodes(const BusTable* table) : table_(table) {}

  /// True if the frame has the id of a node's heartbeat or emergency: then it is nobody else's.
  [[nodiscard]] bool take(const CanFrame& frame, TimeUs now);
  /// After the last frame of a cycle: who is silent is no longer operational.
  void finish(TimeUs now);
  /// Of a message's node; kNoNode always is.
  [[nodiscard]] bool is_operational(std::uint8_t node) const {
    return node == kNoNode || (state_[node].operational && !has_emergency(node));
  }
  [[nodiscard]] bool has_emergency(std::uint8_t node) const {
    return node != kNoNode && state_[node].emergency != 0;
  }
  /// The first of the nodes that have one; its id is 0 if there is none.
  [[nodiscard]] NodeEmergency emergency() const;
  /// The next node to be told to start in this cycle; its id is 0 if there is none.
  [[nodiscard]] NodeStart take_start(TimeUs now);

 private:
  struct State {
    bool operational = false;
    bool waits = false;  ///< To be started.
    bool told = false;
    std::uint16_t emergency = 0;  ///< Its code.
    TimeUs heard_us = 0;
    TimeUs told_us = 0;
  };

  static void take_heartbeat(const CanFrame& frame, TimeUs now, State& state);

  const BusTable* table_;
  std::array<State, kMostTableNodes> state_{};
};

}  // namespace graben
