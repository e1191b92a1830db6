// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Reads a candump log, the one log format of this project, frame by frame.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "can_dbc/codec.hpp"

namespace graben::identify {

struct LoggedFrame {
  std::size_t line = 0;  ///< Of the file, from 1.
  double time_s = 0.0;
  std::uint32_t id = 0;
  bool extended = false;
  std::uint8_t length = 0;
  dbc::Payload data{};
};

/// Of a log whose last line has no end, as one that was being written has.
enum class CutLine { kRefused, kPassedOver };

/// Calls `take` for each data frame of up to 8 bytes, in the file's order; error frames, remote
/// frames and CAN FD are passed over. Plain or gzip. Returns the SHA-256 of the file's content as
/// it is read (unpacked), hexadecimal. Throws std::runtime_error with file and line where a line is
/// none of candump -L's (the last one, if it is cut, only where that is refused), or the file
/// cannot be read or is cut off.
std::string read_candump(const std::filesystem::path& file,
                         const std::function<void(const LoggedFrame&)>& take,
                         CutLine cut = CutLine::kRefused);

}  // namespace graben::identify
