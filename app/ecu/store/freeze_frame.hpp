// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A fault's freeze frame: every second cycle from 0.5 s before it came to 0.2 s after.

#include <array>
#include <cstddef>
#include <cstdint>

#include "app/ecu/store/cycle_sample.hpp"
#include "app/ecu/store/record_format.hpp"
#include "firmware/core/fault_set.hpp"

namespace graben::ecu {

/// Cycles of a sample.
inline constexpr int kSampleEvery = 2;
inline constexpr TimeUs kFrameBeforeUs = 500 * kMillisecondUs;
inline constexpr TimeUs kFrameAfterUs = 200 * kMillisecondUs;
/// Both ends are in it, at 10 ms a cycle.
inline constexpr std::size_t kFrameSamples =
    static_cast<std::size_t>((kFrameBeforeUs + kFrameAfterUs) / (10 * kMillisecondUs)) /
        kSampleEvery +
    1;

struct FreezeFrame {
  FaultSet faults;        ///< That came in this cycle.
  TimeUs came_us = 0;     ///< On the clock of the cycles.
  std::size_t count = 0;  ///< Of its samples, the oldest first.
  std::array<CycleSample, kFrameSamples> sample{};
};

/// A freeze frame as it is stored for one fault. Times of samples count from when the fault came.
struct StoredFrame {
  Fault fault = Fault::kNone;
  SampleKind kind = SampleKind::kExcavator;
  std::uint32_t operation_s = 0;  ///< When it came, in seconds of operation.
  std::uint32_t unix_s = 0;       ///< The same since 1970; 0: not known.
  std::size_t count = 0;
  std::array<CycleSample, kFrameSamples> sample{};
};

/// The payload of `frame`; returns its bytes.
std::size_t write_frame(const StoredFrame& frame, std::uint8_t* payload);
/// False, with nothing to be used in `frame`, if these bytes are no frame.
[[nodiscard]] bool read_frame(const std::uint8_t* payload, std::size_t length, StoredFrame& frame);

}  // namespace graben::ecu
