// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a controller saw of its bus, cycle by cycle, as a file: written on the host, replayed on
/// every target. Little-endian bytes, no alignment; see trace.cpp.

#include <array>
#include <cstdint>
#include <cstdio>

#include "firmware/core/time.hpp"
#include "hal/can_frame.hpp"
#include "hal/can_port.hpp"

namespace graben::timing {

/// Whose controller; the numbers stand in files.
enum class Setup : std::uint8_t {
  kExcavator22t = 0,
  kExcavator12t = 1,
  kDozer = 2,
  kDozerBumps = 3,    ///< On a design with as many corners as there is room for.
  kDozerSurface = 4,  ///< On the shipped design as a surface of triangles gives it: heights.
};
inline constexpr unsigned kSetups = 5;
[[nodiscard]] constexpr bool is_dozer(Setup setup) { return setup >= Setup::kDozer; }

/// Where a trace begins.
struct TraceStart {
  Setup setup = Setup::kExcavator22t;
  std::uint32_t profile_hash = 0;
  std::uint32_t cycles = 0;
};

/// One cycle as the port had it.
struct TraceCycle {
  /// More than a cycle ever takes; EcuNode reads up to 384.
  static constexpr int kMostFrames = 400;
  static constexpr int kMostAnswers = 8;
  static constexpr int kMostSent = 32;

  TimeUs now_us = 0;
  /// What each call of state() and open() gave, in their order.
  std::array<CanPortState, kMostAnswers> state{};
  int states = 0;
  std::array<bool, kMostAnswers> opened{};
  int opens = 0;
  std::uint32_t refused = 0;  ///< A bit for each frame, in the order of sending.
  int frames = 0;
  std::array<CanFrame, kMostFrames> frame{};
  std::uint8_t mode = 0;  ///< Of the controller afterwards.
};

[[nodiscard]] bool write(std::FILE* file, const TraceStart& start);
[[nodiscard]] bool write(std::FILE* file, const TraceCycle& cycle);
/// False at the end of the file, or of what is right in it.
[[nodiscard]] bool read(std::FILE* file, TraceStart& start);
[[nodiscard]] bool read(std::FILE* file, TraceCycle& cycle);

}  // namespace graben::timing
