// SPDX-License-Identifier: Apache-2.0
#include "app/workshop/workshop_bus.hpp"

#include <fmt/format.h>

#include <array>
#include <stdexcept>

#include "platform/linux/cyclic_clock.hpp"
#include "platform/linux/process.hpp"
#include "platform/linux/socketcan_port.hpp"

namespace graben::workshop {

Answered ask(const std::string& interface, std::uint32_t pgn, std::uint8_t ecu) {
  SocketCanPort port(interface, {});
  if (!port.open()) {
    throw std::runtime_error(port.last_error());
  }
  CyclicClock clock(10 * kMillisecondUs);
  Enquiry enquiry(pgn, ecu);
  std::array<CanFrame, 256> heard{};
  TimeUs now = clock.wait().now_us;
  while (enquiry.answer() == Answer::kNone && !stop_requested()) {
    if (port.state() == CanPortState::kDown) {
      throw std::runtime_error(fmt::format("{}: it went down", interface));
    }
    const int count = port.receive(heard.data(), static_cast<int>(heard.size()));
    for (int i = 0; i < count; ++i) {
      enquiry.hear(heard[static_cast<std::size_t>(i)], now);
    }
    while (const std::optional<CanFrame> frame = enquiry.due(now)) {
      if (!port.send(*frame)) {
        throw std::runtime_error(fmt::format("{}: nothing can be sent", interface));
      }
    }
    now = clock.wait().now_us;
  }
  // The last word of a connection.
  while (const std::optional<CanFrame> frame = enquiry.due(now)) {
    static_cast<void>(port.send(*frame));
  }
  return {enquiry.answer(), enquiry.message()};
}

}  // namespace graben::workshop
