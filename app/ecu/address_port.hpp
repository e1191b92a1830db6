// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The controller's port with its claim of an address on the same bus (SAE J1939-81). Who loses the
/// address is off the bus for the controller, as if it were down: it stops, nothing more is sent
/// but that there is no address.

#include "app/ecu/last_frames.hpp"
#include "hal/can_port.hpp"
#include "hal/j1939/address_claim.hpp"

namespace graben::ecu {

class AddressPort : public CanPort {
 public:
  /// All outlive it. Of `last`, what the end of the process sends, nothing is left once the address
  /// is lost.
  AddressPort(CanPort& port, j1939::AddressClaim& claim, LastFrames& last)
      : port_(port), claim_(claim), last_(last) {}

  /// A bus that has come back hears the claim anew.
  [[nodiscard]] bool open() override {
    if (claim_.is_lost() || !port_.open()) {
      return false;
    }
    claim_.begin();
    return true;
  }
  [[nodiscard]] CanPortState state() const override {
    return claim_.is_lost() ? CanPortState::kDown : port_.state();
  }
  [[nodiscard]] int receive(CanFrame* frames, int capacity) override {
    const int count = port_.receive(frames, capacity);
    for (int i = 0; i < count; ++i) {
      claim_.hear(frames[i], now_us_);
    }
    if (claim_.is_lost()) {
      last_.end();
    }
    return count;
  }
  /// The cycle that hears of the loss still sends its frames: they are neutral.
  [[nodiscard]] bool send(const CanFrame& frame) override { return !is_shut_ && port_.send(frame); }

  /// Before a cycle.
  void begin(TimeUs now_us) { now_us_ = now_us; }
  /// After it. What the bus does not take is tried again, five times a second.
  void finish() {
    is_shut_ = claim_.is_lost();
    CanFrame frame;
    if (claim_.due(now_us_, frame)) {
      claim_.tried(now_us_, port_.send(frame));
    }
  }

 private:
  CanPort& port_;
  j1939::AddressClaim& claim_;
  LastFrames& last_;
  TimeUs now_us_ = 0;
  bool is_shut_ = false;
};

/// Says our claim and listens for 250 ms, in which all others may object; of what else comes in
/// meanwhile nothing counts. To be called once, before the first cycle.
void claim_address(AddressPort& port);

}  // namespace graben::ecu
