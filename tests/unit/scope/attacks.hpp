// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What somebody might send to the server, made from a seed.

#include <cstdint>
#include <random>
#include <string>

namespace graben::test {

/// Draws that are the same on every machine, unlike the standard distributions.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : engine_(seed) {}
  /// 0 .. below - 1
  std::uint64_t below(std::uint64_t bound) { return engine_() % bound; }
  bool one_in(std::uint64_t bound) { return below(bound) == 0; }
  std::string bytes(std::size_t count);

 private:
  std::mt19937_64 engine_;
};

/// Bytes without any sense.
[[nodiscard]] std::string raw_bytes(Draw& draw);
/// A request for the page or the WebSocket that is wrong somewhere, or right.
[[nodiscard]] std::string odd_request(Draw& draw, int port);
/// Frames of a WebSocket with any bits: masks, opcodes, lengths, fragments.
[[nodiscard]] std::string odd_frames(Draw& draw);
/// Text messages that are controls, nearly controls, or JSON of any depth.
[[nodiscard]] std::string odd_wishes(Draw& draw);

}  // namespace graben::test
