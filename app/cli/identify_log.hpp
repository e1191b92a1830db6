// SPDX-License-Identifier: Apache-2.0
#pragma once
/// `graben identify --log` and `--check`: logs of our own bus against a machine's profile.

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

/// Writes the new profile, report and summary, or nothing. Throws std::runtime_error that says what
/// is wrong where nothing is written.
void identify_logs(const IdentifyLogCommand& options);

/// Prints how well the profile predicts the logs. Throws as above, and where the limit is exceeded.
void check_logs(const IdentifyLogCommand& options);

}  // namespace graben::cli
