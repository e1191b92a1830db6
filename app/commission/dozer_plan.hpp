// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What is done to identify a dozer, step by step: its blade's cylinders as an excavator's, then
/// both tracks alike, within a way before and behind where the machine stands.

#include <filesystem>
#include <string>
#include <vector>

#include "app/commission/commission_plan.hpp"
#include "app/commission/wrong_way.hpp"
#include "firmware/dozer/dozer_profile.hpp"

namespace graben::commission {

/// Speeds of the tracks that are tried to each side, from slow to fast.
inline constexpr int kTravelLevelCount = 4;

/// Which of a dozer's drives a step tries: the blade's as StepKind has them, or the tracks.
struct TravelStep {
  int sign = 1;        ///< +1 forward.
  int level = 0;       ///< Of the pumps' displacements.
  bool motor = false;  ///< Instead: the motors' displacement, at a small one of the pumps.
};

/// What is to be done; each drive can be left out.
struct DozerOptions {
  /// Lift and tilt, at the places of an excavator's first two cylinders.
  SequenceOptions blade;
  bool has_tilt = false;
  bool tracks = true;
  /// m behind (below 0) and before where the machine stands, and its speed.
  Window way{-3.0, 3.0, 1.2};
};

/// Everything, with the blade no lower than clear of the ground under a level body, and as much
/// higher while it tilts. No end of a stroke is touched: nothing in a dozer's profile says a
/// stroke's zero, which the mark checks.
[[nodiscard]] DozerOptions whole_dozer(const DozerProfile& profile);

[[nodiscard]] std::vector<TravelStep> planned_travel(const DozerOptions& options);

/// "blade", "tilt", "tracks".
inline constexpr const char* kDozerDrives[] = {"blade", "tilt", "tracks"};

/// All steps in words, in their order: "blade, extending: ramp to its edge".
[[nodiscard]] std::vector<std::string> dozer_step_texts(const DozerOptions& options);
/// "the blade's stroke falls while it is told to extend: sensor or valve reversed".
[[nodiscard]] std::string dozer_wrong_text(const WrongWay& wrong);
/// A line for each drive that is tried: its window, as the operator confirms it.
[[nodiscard]] std::vector<std::string> dozer_window_texts(const DozerOptions& options);

/// Throws std::runtime_error unless each window that is tried is one that may be confirmed.
void require_possible(const DozerOptions& options);

/// Reads and checks windows: a table for each drive, [blade], [tilt], [tracks], with `least`,
/// `most` (m; of the tracks behind, below 0, and before) and `speed` (m/s). A drive without one is
/// not tried, for nobody has confirmed where it may go. Throws machines::ProfileError with every
/// error found.
void read_dozer_windows(const std::filesystem::path& file, DozerOptions& options);

}  // namespace graben::commission
