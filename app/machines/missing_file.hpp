// SPDX-License-Identifier: Apache-2.0
#pragma once
/// One wording for every file that a command was to read and that is not there.

#include <filesystem>
#include <string>
#include <system_error>

namespace graben::machines {

/// "none.log: there is no such file; wanted: ...", where `wanted` says what was expected and where
/// that comes from; of a file that is there, why it cannot be read.
[[nodiscard]] inline std::string unread_text(const std::filesystem::path& file,
                                             const std::string& wanted) {
  std::error_code error;
  const bool is_there = std::filesystem::exists(file, error);
  const char* why = error                                        ? "can't be reached"
                    : !is_there                                  ? "there is no such file"
                    : std::filesystem::is_directory(file, error) ? "is a folder"
                                                                 : "can't be read";
  return file.string() + ": " + why + "; wanted: " + wanted;
}

/// What a log is, and how one comes about.
inline constexpr const char* kWantedLog =
    "a log (candump -L), such as graben dig, graben grade and candump -L write";

}  // namespace graben::machines
