// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The way from wherever the machine stands to a program's first pose: several are tried, and the
/// first that keeps clear of the fences is taken. Looked at a little in every cycle while the
/// machine stands.

#include "firmware/excavator/excavator_profile.hpp"
#include "firmware/excavator/motion/program/task_program.hpp"

namespace graben {

/// Most legs of an approach. [-; size: three places on the way and the start]
inline constexpr int kApproachLegs = 4;

/// Moves straight in drive space, one after the other. The last ends at the program's start.
struct ApproachPath {
  std::array<DriveVector, kApproachLegs> from;  ///< Where each begins.
  std::array<SineRamp, kApproachLegs> ramp;     ///< Without duration where there is nothing to go.
  int legs = 0;
};

[[nodiscard]] DrivePlan approach_leg(const ApproachPath& path, const TaskProgram& program, int leg);

/// Ways that are tried, in this order.
enum class ApproachWay : std::uint8_t {
  /// To above the first pose and down to it, so that a bucket that stands in a cut comes out of it
  /// before it goes back; at once down where it is near, or where nothing above can be had.
  kDirect = 0,
  kSwingFirst = 1,
  kOver = 2,       ///< The boom up, then the swing, then as kDirect.
  kFolded = 3,     ///< The same with arm and bucket folded in,
  kFoldedLow = 4,  ///< and the boom half way up.
  kSwingLast = 5,
  kBoomFirst = 6,  ///< The boom to where it is above the first pose, all cylinders, the swing.
};

/// Ways of an approach. [-; derived: number of ApproachWay's values]
inline constexpr int kApproachWays = 7;

/// `drives_now` are taken into their ranges.
[[nodiscard]] ApproachPath approach_path(const ExcavatorProfile& profile,
                                         const SwingKinematics& kinematics,
                                         const TaskProgram& program, const DriveVector& drives_now,
                                         ApproachWay way);

/// State from cycle to cycle. As constructed nothing is searched.
struct ApproachSearch {
  bool runs = false;
  bool planned = false;     ///< There is a path of `way`.
  bool found = false;       ///< `way` is free.
  bool failed = false;      ///< None is.
  std::uint8_t number = 0;  ///< Of the task.
  std::uint8_t way = 0;
  std::uint8_t leg = 0;
  std::uint8_t sample = 0;
  /// A bit a gap: the leg has begun beyond it, and has to lead away until it is not.
  std::array<std::uint16_t, kFenceMost> leaves{};
  std::array<std::uint16_t, kFenceMost> closes{};  ///< At the last sample.
};

/// Poses that a leg is looked at in. [-; size: between two of them a point's distance from a plane
/// has its least within a millimetre of what it is at one; before a keep-out it is bounded by its
/// slope]
inline constexpr int kApproachSamples = 64;
/// Poses that are looked at in a cycle. [-; size: of a cycle's time; 3 before]
inline constexpr int kSamplesPerCycle = 2;

/// A cycle on; `path` is that of the way that is looked at, from `drives_now` on. One cycle plans a
/// way, the next ones look at it. Each leg has to keep planned_margin_m() from every fence; what
/// the machine is nearer to, or beyond, where a leg begins it may only lead away from. A program
/// without fences is found at once.
void search_approach(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                     const TaskProgram& program, const DriveVector& drives_now,
                     ApproachSearch& search, ApproachPath& path);

}  // namespace graben
