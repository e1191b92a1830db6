#pragma once
/// What was refused on the way in, and why.

#include <cstdint>

namespace graben {

/// Frames by what became of them. The counters stay at their maximum.
struct LinkCounters {
  std::uint32_t accepted = 0;
  std::uint32_t synchronising = 0;  ///< Good, but the sender's sequence is not confirmed yet.
  std::uint32_t wrong_kind = 0;     ///< Remote, error, FD, or an 11-bit frame with one of our ids.
  std::uint32_t wrong_length = 0;
  std::uint32_t wrong_crc = 0;
  std::uint32_t masquerade = 0;     ///< A wrong CRC that fits another message; not in wrong_crc.
  std::uint32_t wrong_counter = 0;  ///< Repeated, invalid, late, early, or too many lost.
  std::uint32_t out_of_range = 0;   ///< A value outside its [min|max] behind a right CRC.
  std::uint32_t surplus = 0;        ///< More at once than are looked at (MessageLinks).
};

/// All that were refused. Frames of a start-up handshake are not: every start has some.
constexpr std::uint32_t rejected(const LinkCounters& counters) {
  const std::uint64_t sum = std::uint64_t{counters.wrong_kind} + counters.wrong_length +
                            counters.wrong_crc + counters.masquerade + counters.wrong_counter +
                            counters.out_of_range + counters.surplus;
  return sum > UINT32_MAX ? UINT32_MAX : static_cast<std::uint32_t>(sum);
}

}  // namespace graben
