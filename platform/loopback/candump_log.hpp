// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The one log format: candump, as can-utils write and read it.

#include <cstdio>
#include <filesystem>
#include <string>

#include "firmware/core/time.hpp"
#include "hal/can_frame.hpp"

namespace graben {

/// Writes a log; unless it grows, beside its final name, renamed when closed, so that an
/// interrupted run leaves no half log behind. Errors throw std::runtime_error that names the file.
class CandumpLog {
 public:
  /// How the file comes about.
  enum class Form {
    kWhole,  ///< Beside its name until it is closed.
    kGrows,  ///< In place, after what is there; a last line that is cut off is taken away.
  };

  CandumpLog(const std::filesystem::path& file, std::string interface_name,
             Form form = Form::kWhole);
  CandumpLog(const CandumpLog&) = delete;
  CandumpLog& operator=(const CandumpLog&) = delete;
  ~CandumpLog();

  void write(const CanFrame& frame, TimeUs now_us);
  /// What is written so far is in the file, whatever becomes of this process.
  void flush();
  void close();

 private:
  std::filesystem::path file_;
  std::filesystem::path part_;
  std::string interface_name_;
  std::FILE* stream_;
};

/// One line of a log, without its end: "(seconds) interface id#data".
[[nodiscard]] std::string candump_line(const CanFrame& frame, TimeUs now_us,
                                       const std::string& interface_name);

}  // namespace graben
