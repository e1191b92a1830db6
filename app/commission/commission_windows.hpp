// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the operator confirms before anything moves: of each drive the window, the speed, and which
/// ends of its stroke are free to be touched.

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "app/commission/commission_plan.hpp"

namespace graben::commission {

/// As it is proposed, and as it is confirmed. An end that is free is in the window.
struct DriveAnswer {
  Window window;
  bool retracted_end_free = false;
  bool extended_end_free = false;
};

/// From 5 % to 95 % of the stroke, no end free.
[[nodiscard]] DriveAnswer proposed_answer(double stroke_m);

/// Reads and checks windows of the drives that `options` has: a table for each, [boom], [arm],
/// [bucket], with `least`, `most` (m; left out where that end is free), `speed` (m/s), and, false
/// unless told, `retracted_end_free`, `extended_end_free`. Sets them in `options`. Throws
/// machines::ProfileError with every error found. A table [swing] has `right`, `left` (rad) and
/// `speed` (rad/s); without it the swing is not tried, for nobody has confirmed where it may turn.
void read_windows(const std::filesystem::path& file, SequenceOptions& options);

/// Asks for a line with these words; nothing at the end of the answers.
using Ask = std::function<std::optional<std::string>(const std::string&)>;

/// The same by questions, a drive after the other; an empty answer takes what is proposed, one that
/// cannot be is asked again. False if the answers end before.
[[nodiscard]] bool ask_windows(const Ask& ask, SequenceOptions& options);

/// Throws std::runtime_error unless the window is one that may be confirmed for this stroke.
void require_possible(const Window& window, double stroke_m, const std::string& name);

/// Throws std::runtime_error unless the sector is one that may be confirmed.
void require_possible(const Sector& sector);

/// "swing: from -30 deg (right) to 30 deg (left), at most 0.60 rad/s".
[[nodiscard]] std::string sector_text(const Sector& sector);

/// "boom: 0.070 to 1.330 of 1.400 m, at most 0.50 m/s, its ends are not touched".
[[nodiscard]] std::string window_text(const SequenceOptions& options, int axis);

}  // namespace graben::commission
