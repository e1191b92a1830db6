// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Roll of the body: what the slope across of the ground below its tracks will make of it.

#include "firmware/dozer/grade_profile.hpp"

namespace graben {

/// About the body's longitudinal axis, left side up.
struct BodyRoll {
  double roll_rad = 0.0;
  double rate_radps = 0.0;
};

/// Slope across below the tracks, on the design as already cut, and how it changes along x: the
/// mean over their contact, with the body's origin at `x_m`.
[[nodiscard]] CrossSample cross_below_tracks(const DozerBody& body, const GradeProfile& design,
                                             double x_m);

/// `lead_s` on, from where the origin is at `from_m` to where it is then, driving with `speed_mps`:
/// the springs are stiff against roll, so that it goes on as the ground below the tracks does. What
/// the measured rate has more than that is rocking, which dies away.
[[nodiscard]] BodyRoll roll_after(const DozerBody& body, const GradeProfile& design,
                                  const BodyRoll& measured, double from_m, double to_m,
                                  double speed_mps, double lead_s);

}  // namespace graben
