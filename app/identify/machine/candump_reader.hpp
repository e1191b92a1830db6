// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Reads a log frame by frame: candump's (candump_line.hpp), the one log format of this project,
/// and those of other tools that turn into it (other_logs.hpp).

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/identify/machine/log_clock.hpp"
#include "can_dbc/codec.hpp"

namespace graben::identify {

struct LoggedFrame {
  std::size_t line = 0;  ///< Of the file, from 1.
  double time_s = 0.0;   ///< Never goes back.
  std::uint32_t id = 0;  ///< Of a message of our DBCs theirs, whatever priority it came with.
  bool extended = false;
  std::uint8_t length = 0;
  dbc::Payload data{};
  std::size_t piece = 0;  ///< Of the log, from 0: between two, no time counts.
};

/// What was in a log beside the frames that were handed on.
struct LogRead {
  std::string name;                ///< Of the file, as it was told.
  std::string sha256;              ///< Of its content as it is read (unpacked), hexadecimal.
  std::string format = "candump";  ///< Whose lines it has: candump, ASC, TRC, BLF.
  std::size_t frames = 0;
  std::size_t other = 0;   ///< Lines of frames that no machine of ours sends.
  std::size_t broken = 0;  ///< Lines that are none, but for a last one that is cut.
  std::size_t first_broken = 0;
  bool is_cut = false;     ///< Whoever wrote it had not come to the end of the last line.
  std::uint64_t lost = 0;  ///< Frames that the log itself says it lacks.
  std::vector<ClockBreak> breaks;
  std::size_t disordered = 0;  ///< Frames with a stamp before that of the frame before them.
  std::size_t garbled = 0;     ///< Frames left out for their stamp.

  /// A sentence for each of these that its reader has to know, with the file's name.
  [[nodiscard]] std::vector<std::string> notes() const;
};

/// Calls `take` for each data frame of up to 8 bytes, in the file's order; what else is in it is
/// counted. Plain or gzip, or BLF. Throws std::runtime_error with file and line where more lines
/// are broken than whole, or the file cannot be read or is cut off.
LogRead read_candump(const std::filesystem::path& file,
                     const std::function<void(const LoggedFrame&)>& take);

/// A log that is none of candump's, but one that is read (other_logs.hpp); for the page, which
/// reads candump's alone, its frames as lines of those.
[[nodiscard]] bool is_other_log(const std::filesystem::path& file);
/// `read`, unless null: what of it was left out.
[[nodiscard]] std::string candump_text(const std::filesystem::path& file, LogRead* read = nullptr);

}  // namespace graben::identify
