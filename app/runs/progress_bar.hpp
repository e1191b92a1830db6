#pragma once
/// Progress on standard error: a bar that redraws itself on a terminal, nothing elsewhere.

#include <chrono>
#include <string>

namespace graben::runs {

class ProgressBar {
 public:
  explicit ProgressBar(std::string label);
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  /// Clears the bar's line.
  ~ProgressBar();

  /// `share` of the work done, 0 .. 1, and a few words on where it stands. Redraws at most ten
  /// times a second.
  void show(double share, const std::string& where);

 private:
  std::string label_;
  bool terminal_;
  std::chrono::steady_clock::time_point started_;
  std::chrono::steady_clock::time_point drawn_;
};

}  // namespace graben::runs
