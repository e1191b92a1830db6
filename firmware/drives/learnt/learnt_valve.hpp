// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a drive's valve turns out to be: where its dead band ends on each side and how it opens,
/// learnt from spool and stroke while the drive works, within bounds, and kept as long as the
/// process runs.
///
/// Opening: as the profile's table has it of its side, 0 .. 1. The real valve needs an opening
/// `beyond` the profile's for the same speed: edge * (1 - o) + bend * curve(o). The first is a dead
/// band that ends elsewhere; the curve, about -o ln(o), is another exponent. What else the
/// profile's flow is off (areas, pumps, pressures) is learnt with them, as an opening.

#include <array>
#include <cstdint>

#include "firmware/drives/drive_validation.hpp"

namespace graben {

/// Of one side: edge and bend, and how far they may be off. As constructed only the profile is
/// known: dead band within 2.4 % of the travel, exponent within 9 % (standard deviations).
struct LearntSide {
  double edge = 0.0;
  double bend = 0.0;
  double edge_variance;
  double covariance = 0.0;
  double bend_variance;

  LearntSide();
};

/// Of the last cycle; signed, extension is positive.
struct LearntAsk {
  double speed_mps = 0.0;  ///< For which the valve was opened ...
  double opening = 0.0;    ///< ... so far, by the profile.
};

/// What is compared.
struct LearntSeen {
  LearntAsk asked;
  double opening = 0.0;  ///< Where the spool is.
  double speed_mps = 0.0;
};

/// State of one drive from cycle to cycle.
struct LearntValve {
  LearntSide extend;
  LearntSide retract;
  std::array<LearntAsk, 2> late;  ///< A command on its way to the drive's speed.
  LearntSeen seen;                ///< Low-passed.
  double stroke_m = 0.0;
  double unmoved_s = 0.0;  ///< That a motor has stood under an open spool.
  double still_s = 0.0;    ///< So long a cylinder has stood in the air at its edge.
  double turning_s = 0.0;  ///< Since a motor last stood.

  [[nodiscard]] const LearntSide& side(bool extends) const;
};

/// Of a valve whose edges meter the flow. Of a motor only where its dead band ends, from whether it
/// moves at all: its load takes seconds to get its speed.
/// None where nothing is to be learnt (`learns`).
[[nodiscard]] bool is_learnt(const DriveRow& drive);

/// What a valve may be learnt from.
enum class LearntFrom : std::uint8_t {
  kNothing,      ///< The drive is not in motion, or its load holds it.
  kPlainMotion,  ///< Soil may press: 10 mm/s and a quarter to four times what is asked.
  kAnyMotion,    ///< In the air: also what is slow, or far from what is asked.
};

/// A cycle on. Nothing is learnt where the opening changes fast; nor of a valve whose inlet meters
/// the flow. A slow path needs kAnyMotion: a valve that opens too soon is asked for next to nothing
/// there, its feedback takes back the rest, and one that opens too late does next to nothing.
void next_learnt(const DriveRow& drive, const ValidDrive& seen, const LearntAsk& ask,
                 LearntFrom from, double period_s, LearntValve& valve);

/// A cylinder stands under a spool that should be open beyond what makes its line press as hard as
/// its load; of a line whose bypass closes over the opening alone.
[[nodiscard]] bool stands_open(const LearntValve& valve);

/// The dead band's end on a side, from the profile's, as a share of the spool's travel.
[[nodiscard]] double learnt_edge_ratio(const DriveRow& drive, const LearntValve& valve,
                                       bool extends);

/// Its variance is at most half of that before anything was learnt.
[[nodiscard]] bool is_edge_known(const LearntSide& side);

/// What the real valve needs beyond the profile's opening.
[[nodiscard]] double opening_beyond(const LearntSide& side, double opening);

/// Standard deviation of that.
[[nodiscard]] double opening_spread(const LearntSide& side, double opening);

/// Signed duty, -1 .. 1, at which the real valve does what the profile's would at this opening.
[[nodiscard]] double learnt_duty(const DriveRow& drive, const LearntValve& valve, double opening);

/// The profile's opening at which its valve does what the real one does at this one; below 0 in the
/// dead band.
[[nodiscard]] double opening_by_profile(const LearntSide& side, double opening);

}  // namespace graben
