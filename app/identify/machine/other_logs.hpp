// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Logs of other tools, told by what they contain, as lines of candump's kinds. Sources: the
/// formats as python-can (5.0) reads and writes them, its io/asc.py, io/trc.py and io/blf.py.
///
///   ASC  Vector's text; begins with its date, its base or a version
///   TRC  PEAK's text, versions 1.0 to 2.1; begins with ";$FILEVERSION" or ";##"
///   BLF  Vector's binary; begins with "LOGG"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "app/identify/machine/candump_line.hpp"

namespace graben::identify {

/// Reads lines of the one kind of text that a log is.
class LogText {
 public:
  /// By the log's first line that is not empty.
  explicit LogText(std::string_view first_line);

  [[nodiscard]] bool is_candump() const { return kind_ == Kind::kCandump; }
  /// "candump", "ASC" or "TRC".
  [[nodiscard]] const char* format() const {
    return is_candump() ? "candump" : (kind_ == Kind::kAsc ? "ASC" : "TRC");
  }
  [[nodiscard]] CandumpLine parse(std::string_view line);

 private:
  enum class Kind { kCandump, kAsc, kTrc };

  [[nodiscard]] CandumpLine asc(std::string_view line);
  [[nodiscard]] CandumpLine trc(std::string_view line);
  [[nodiscard]] CandumpLine trc_header(std::string_view line);

  Kind kind_ = Kind::kCandump;
  bool is_decimal_ = false;   ///< ASC: numbers of ids and bytes.
  bool is_relative_ = false;  ///< ASC: stamps are times since the line before.
  double last_s_ = 0.0;
  int version_ = 10;                 ///< TRC, ten times.
  std::string columns_ = "NOTIdlD";  ///< TRC 2: a letter each.
};

[[nodiscard]] bool is_blf(std::string_view begin);

/// Calls `take` for each object of a BLF's bytes that is a frame; `number` counts objects from 1.
/// What is wrong with it; empty: nothing.
[[nodiscard]] std::string read_blf(
    std::string_view bytes,
    const std::function<void(std::size_t number, const CandumpLine& line)>& take);

/// What a file is that no reader is here for, by its begin; empty: nothing known.
[[nodiscard]] std::string foreign_log(std::string_view begin);

}  // namespace graben::identify
