#pragma once
/// What a controller heard and said in a run of the simulated machine: written by write_replay.

#include <array>
#include <cstddef>
#include <cstdint>

namespace graben::memory {

struct ReplayFrame {
  std::uint16_t cycle;  ///< From 0.
  bool sent;            ///< By the controller; else heard by it before it was its turn.
  std::uint8_t length;
  std::uint32_t id;
  std::array<std::uint8_t, 8> data;
};

struct Replay {
  const ReplayFrame* frame;
  std::size_t count;
  int cycles;
};

[[nodiscard]] Replay replay();

}  // namespace graben::memory
