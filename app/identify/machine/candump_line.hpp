// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A line that candump writes, of any version: `-L` and `-l`, and with `-t a` on the terminal. The
/// page reads the same ones (app/scope/page/src/model/candump.ts); what both make of each is in
/// app/scope/page/test/candump_cases.json.
///
///   (1700000000.123456) can0 18FF2080#0011223344556677
///   (1700000000.123456)   can0 123#00_9                   names are padded, a raw length follows
///   (1700000000.123456) can0 123#R8                       a remote frame
///   (1700000000.123456) can0 123##1AABB                   a frame of CAN FD
///   (1700000000.123456) can0 00123#81:00:00000000#AABB    one of CAN XL
///    (1700000000.123456)  can0  123   [2]  AA BB  '..'    as on the terminal
///   DROPCOUNT: dropped 3 CAN frames on 'can0' socket (total drops 3)

#include <cstdint>
#include <string_view>

#include "can_dbc/codec.hpp"

namespace graben::identify {

enum class LineKind {
  kFrame,   ///< A data frame of up to 8 bytes.
  kOther,   ///< A whole line, of a frame that no machine of ours sends: remote, error, FD, XL.
  kLost,    ///< Says that frames were lost.
  kBroken,  ///< None of candump's.
};

struct CandumpLine {
  LineKind kind = LineKind::kBroken;
  double time_s = 0.0;
  std::uint32_t id = 0;
  bool extended = false;
  std::uint8_t length = 0;
  dbc::Payload data{};
  std::uint64_t lost = 0;  ///< Frames.
};

/// Without the line's end.
[[nodiscard]] CandumpLine parse_candump(std::string_view line);

}  // namespace graben::identify
