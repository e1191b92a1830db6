// SPDX-License-Identifier: Apache-2.0
#include "app/ecu/address_port.hpp"

#include <array>
#include <chrono>
#include <thread>

#include "platform/linux/cyclic_clock.hpp"

namespace graben::ecu {

void claim_address(AddressPort& port) {
  constexpr int kBatch = 96;
  constexpr std::chrono::milliseconds kLook{5};
  std::array<CanFrame, kBatch> frames;
  const TimeUs from_us = monotonic_now_us();
  for (TimeUs now_us = from_us; now_us - from_us < j1939::kClaimWaitUs;
       now_us = monotonic_now_us()) {
    port.begin(now_us);
    static_cast<void>(port.receive(frames.data(), kBatch));
    port.finish();
    std::this_thread::sleep_for(kLook);
  }
}

}  // namespace graben::ecu
