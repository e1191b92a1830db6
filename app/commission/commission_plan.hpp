// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What is done to identify an excavator, step by step, and how each step may end.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "firmware/excavator/excavator_profile.hpp"

namespace graben::commission {

/// Steps of each direction, from slow to fast.
inline constexpr int kLevelCount = 5;
/// The same of the swing, whose ramp is slow enough to be the first of them.
inline constexpr int kSwingLevelCount = 4;
/// The end of a stroke is nearer than that to where the sensor says that it is.
inline constexpr double kEnd_m = 0.030;

/// Where a cylinder may be and how fast, as the operator has confirmed it.
struct Window {
  double least_m = 0.0;
  double most_m = 0.0;
  double most_mps = 0.0;
};

/// Where the platform may be and how fast: no farther than that to either side, whatever it is
/// asked. Kept by whoever leads the sequence; the controller keeps the swing's own range and the
/// fences.
struct Sector {
  double right_rad = -0.52;
  double left_rad = 0.52;
  double most_radps = 0.6;
};

/// What is to be done; each part can be left out.
struct SequenceOptions {
  std::array<Window, kAxisCount> window{};
  std::array<double, kAxisCount> stroke_m{};  ///< Of the cylinders.
  std::array<int, kAxisCount> pump{};         ///< Which feeds each.
  std::array<bool, kAxisCount> drives = {true, true, true};
  std::array<bool, kAxisCount> touch_extended = {true, true,
                                                 true};  ///< Only where its window reaches there.
  std::array<bool, kAxisCount> touch_retracted = {true, true, true};
  bool steps = true;
  bool bursts = true;
  bool pairs = true;       ///< Two drives of one pump at once.
  bool has_swing = false;  ///< The profile has one.
  bool swing = false;      ///< It is tried.
  Sector sector;
  double brakes_radps2 = 0.0;  ///< What closed ports and their reliefs surely give the platform.
  /// Strokes with the arm pulled in and the bucket off the ground, before the platform turns.
  std::array<double, kAxisCount> folded_m{};
  std::array<int, kAxisCount> first_sign = {1, 1, 1};  ///< Way that each is tried first.
  /// Shares of the window that a step wants before it: of the slowest, more for each next one, at
  /// most. Where strokes are short, fast steps want nearly all.
  double room = 0.20;
  double room_per_level = 0.08;
  double room_most = 0.5;
  /// A drive's first ramp goes on until such a share of its window is before the other one.
  double first_inside = 0.0;
  double there_m = 0.03;  ///< So near to where a step begins counts as there.
  /// Where the first drive is to stand while others are tried, once it is known; without: anywhere.
  std::optional<double> parked_m;
};

/// Everything that there is, over the whole strokes; what is too near to an end for the machine's
/// surroundings is for the operator to take out.
[[nodiscard]] SequenceOptions whole_sequence(const ExcavatorProfile& profile);

/// kFold brings the links to `folded_m`, before the swing's own steps, which are last.
enum class StepKind { kRamp, kStep, kBurst, kTouch, kPair, kFold };

/// One thing that is tried.
struct SequenceStep {
  StepKind kind = StepKind::kRamp;
  int axis = 0;    ///< kSwing: the swing.
  int sign = 0;    ///< +1 extends, turns to the left.
  int level = 0;   ///< Of kStep and kPair: which of the five.
  int other = -1;  ///< Of kPair: the second drive.
};

/// How a step ended. kOutside: the platform stood outside its sector, nothing was tried. kNoTime:
/// it was left out, so that all stays within five minutes.
enum class StepEnd { kDone, kAtWindow, kNoMotion, kOutside, kNoTime };

/// What became of a step; with the plan's order all that is needed to go on after a break.
struct StepResult {
  StepEnd end = StepEnd::kDone;
  double duty = 0.0;       ///< Largest magnitude that was tried.
  double speed_mps = 0.0;  ///< Largest that came of it; of the swing rad/s.
  double took_s = 0.0;     ///< With the way to where it began, and until all stood again.
};

/// All steps of it in their order.
[[nodiscard]] std::vector<SequenceStep> planned_steps(const SequenceOptions& options);

/// "boom", "arm", "bucket", "swing".
[[nodiscard]] const char* axis_name(int axis);
/// "boom, extending: ramp to its edge".
[[nodiscard]] std::string step_text(const SequenceStep& step);
/// "done", "at window", "no motion", "outside", "no time".
[[nodiscard]] const char* end_text(StepEnd end);
/// "63 mm/s", or of the swing "0.21 rad/s".
[[nodiscard]] std::string speed_text(const SequenceStep& step, const StepResult& result);

}  // namespace graben::commission
