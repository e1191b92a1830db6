// SPDX-License-Identifier: Apache-2.0
#pragma once
/// `graben identify --log` and `--check`: logs of our own bus against a machine's profile.

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace graben::cli {

struct IdentifyLogCommand {
  std::vector<std::string> logs;
  std::string profile;
  std::string out;
  std::string report;
  std::string summary;
  std::string before;          ///< With `check`: an older profile beside it.
  bool check = false;          ///< Judges the profile; writes none.
  double limit_percent = 0.0;  ///< Of `check`: largest difference of a speed; 0: none.
  bool any_machine = false;
  bool strokes_measured = false;  ///< By a tape: what the sensors show is right.
  bool force = false;
};

/// Digits of a log's hash that a profile keeps.
inline constexpr std::size_t kShortHash = 12;

struct NamedLog {
  std::string name;
  std::string sha256;
};

/// "drive.log sha256 12ab34cd56ef, 2026-11-24".
[[nodiscard]] std::string source_text(const std::vector<NamedLog>& logs);

/// All of a file.
[[nodiscard]] std::string text_of(const std::filesystem::path& file);

/// What was found goes into the profile's own text: where that is like another, it has to be like
/// the same one where it is written. Else throws std::runtime_error.
void assert_same_base(const std::filesystem::path& file, const std::filesystem::path& out);

/// Writes the new profile, report and summary, or nothing. Throws std::runtime_error that says what
/// is wrong where nothing is written.
void identify_logs(const IdentifyLogCommand& options);

/// Prints how well the profile predicts the logs. Throws as above, and where the limit is exceeded.
void check_logs(const IdentifyLogCommand& options);

}  // namespace graben::cli
