// SPDX-License-Identifier: Apache-2.0
#pragma once
/// An ECU's cycles with diagnosis, and a workshop's tool on its bus.

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "hal/j1939/diagnostics.hpp"
#include "hal/link/dm1.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/hal/j1939_reader.hpp"

namespace graben::test::workshop {

using namespace graben::j1939;

inline constexpr TimeUs kCycleUs = 10 * kMillisecondUs;
inline constexpr std::uint8_t kOwn = 0x82;
inline constexpr std::uint8_t kTool = 0xF9;
inline constexpr std::array<std::uint32_t, 2> kSent = {0x18FF3182, 0x18FECA82};
inline constexpr std::uint32_t kDm1 = 65226;
inline constexpr std::uint32_t kDm2 = 65227;
inline constexpr std::uint32_t kDm3 = 65228;
inline constexpr std::uint32_t kDm11 = 65235;
inline constexpr std::uint32_t kAck = 59392;

/// An ECU's cycles: what it sends of itself, and what diagnosis makes of it.
class Ecu {
 public:
  void cycle() {
    state.can_clear = can_clear;
    // As EcuNode does: single codes are on their way before the cycle's faults are known here.
    Dm1Content content;
    if (single_.due(state.active, now, content)) {
      CanFrame frame;
      frame.id = 0x18FECA82;
      frame.length = 8;
      frame.stamp_us = now;
      frame.data[0] = static_cast<std::uint8_t>((content.amber_warning ? 4U : 0U) |
                                                (content.red_stop ? 16U : 0U));
      frame.data[1] = frame.data[6] = frame.data[7] = 0xFF;
      frame.data[2] = static_cast<std::uint8_t>(content.spn);
      frame.data[3] = static_cast<std::uint8_t>(content.spn >> 8U);
      frame.data[4] = static_cast<std::uint8_t>(content.spn >> 16U << 5U | content.fmi);
      frame.data[5] = content.occurrences;
      assert_true(diagnostics.holds(frame));
    }
    const DiagnosticWork work = diagnostics.step(state, now);
    most_frames = std::max(most_frames, work.count);
    for (std::size_t i = 0; i < work.count; ++i) {
      tool.hear(work.frame[i]);
    }
    for (int number = 1; number < kFaultCount; ++number) {
      if (work.cleared.has(static_cast<Fault>(number))) {
        state.stored[static_cast<std::size_t>(number)] = 0;
        ++cleared;
      }
    }
    now += kCycleUs;
  }
  void run(double seconds) {
    repeat(static_cast<int>(seconds * 100.0 + 0.5), [&] { cycle(); });
  }
  void activate(Fault fault) { state.active.add(fault); }
  void store(Fault fault, std::uint8_t times) {
    state.stored[static_cast<std::size_t>(fault)] = times;
  }
  void raw(std::uint32_t id, std::uint8_t length, const std::array<std::uint8_t, 8>& data) {
    CanFrame frame;
    frame.id = id;
    frame.length = length;
    frame.data = data;
    frame.stamp_us = now;
    diagnostics.hear(frame, now);
  }
  void request(std::uint32_t pgn, std::uint8_t receiver = kOwn, std::uint8_t sender = kTool,
               std::uint8_t length = 3) {
    raw(0x18EA0000U | static_cast<std::uint32_t>(receiver) << 8U | sender, length,
        {static_cast<std::uint8_t>(pgn), static_cast<std::uint8_t>(pgn >> 8U),
         static_cast<std::uint8_t>(pgn >> 16U), 0xFF, 0xFF, 0xFF, 0xFF, 0xFF});
  }
  /// Acknowledgments since the last call, their control bytes; each names who asked and for what.
  std::vector<unsigned> acknowledged(std::uint32_t pgn) {
    std::vector<unsigned> controls;
    const auto all = tool.of(kAck);
    for (; acks_ < all.size(); ++acks_) {
      const auto& bytes = all[acks_].bytes;
      assert_int_equal(all[acks_].receiver, 255);
      assert_int_equal(bytes[4], kTool);
      assert_int_equal(bytes[5] | bytes[6] << 8U | bytes[7] << 16U, pgn);
      controls.push_back(bytes[0]);
    }
    return controls;
  }

  Diagnostics diagnostics{kOwn, kSent.data(), kSent.size()};
  DiagnosticState state;
  graben::test::J1939Reader tool;
  TimeUs now = kSecondUs;
  bool can_clear = true;
  int cleared = 0;
  std::size_t most_frames = 0;

 private:
  Dm1 single_;
  std::size_t acks_ = 0;
};

inline void activate_all(Ecu& ecu) {
  for (int number = 1; number < kFaultCount; ++number) {
    ecu.activate(static_cast<Fault>(number));
  }
}

using Acks = std::vector<unsigned>;

}  // namespace graben::test::workshop
