// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What was learnt of an excavator's valves, as one run hands it to the next: where the dead band
/// ends on each side, in openings beyond the profile's. How a valve opens behind it (the bend of
/// learnt_valve.hpp) has oil, pumps and pressures of that run in it and stays. Of 40 draws of the
/// 22 t as found that dig again, dry and at full speed, the largest error is 16.6 mm in the mean
/// with the edges, 17.6 with both, 18.5 with nothing kept; with both 7 are over 3 mm worse.

#include <array>

#include "firmware/drives/drive_watch.hpp"
#include "firmware/excavator/excavator_profile.hpp"

namespace graben {

struct LearntDeadBand {
  double extend = 0.0;
  double retract = 0.0;
};

/// Boom, arm, bucket, swing. What is not learnt is 0.
using LearntDrives = std::array<LearntDeadBand, kDriveCount>;

/// Finite, and within what a run may learn.
[[nodiscard]] bool is_sound(const LearntDrives& learnt);

[[nodiscard]] LearntDrives learnt_of(const DriveWatchState<kDriveCount>& state);

/// Begins with what was learnt before. How far it may be off is as of a profile that nothing was
/// learnt of yet: the oil is cold, and a valve may have been changed.
void begin_learnt(const LearntDrives& learnt, DriveWatchState<kDriveCount>& state);

}  // namespace graben
