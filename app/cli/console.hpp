// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Parts that the commands share on their way to the user: progress and errors.

#include <fmt/format.h>

#include <chrono>
#include <exception>
#include <filesystem>
#include <string>

#include "app/runs/logged_run.hpp"

namespace graben::cli {

/// Of work that threw: 130 where Ctrl-C had ended it, as a shell says it; else 1.
[[nodiscard]] int failed_status();

/// 0 if `work` returned, failed_status() with its message on standard error if it threw.
template <class Work>
int guarded(const char* command, Work work) {
  try {
    work();
    return 0;
  } catch (const std::filesystem::filesystem_error& error) {
    // Its own text is the library's, with the call that failed.
    fmt::print(stderr, "graben {}: {}: {}\n", command, error.path1().string(),
               error.code().message());
    return failed_status();
  } catch (const std::exception& error) {
    fmt::print(stderr, "graben {}: {}\n", command, error.what());
    return failed_status();
  }
}

/// Throws std::runtime_error once a signal that ends a program has come; see catch_stop_signals().
void assert_not_stopped();

/// Progress on standard error: a bar that redraws itself on a terminal, nothing elsewhere.
class ProgressBar {
 public:
  explicit ProgressBar(std::string label);
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  /// Clears the bar's line.
  ~ProgressBar();

  /// `share` of the work done, 0 .. 1, and a few words on where it is. Redraws at most ten times a
  /// second.
  void show(double share, const std::string& where);
  /// show(), for a run; this must outlive it.
  [[nodiscard]] runs::Progress progress();
  /// The same, for a run that leaves nothing unless it comes to its end: throws std::runtime_error
  /// once SIGINT or SIGTERM has come.
  [[nodiscard]] runs::Progress progress_until_stopped();

 private:
  std::string label_;
  bool terminal_;
  std::chrono::steady_clock::time_point started_;
  std::chrono::steady_clock::time_point drawn_;
};

}  // namespace graben::cli
