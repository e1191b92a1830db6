// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Where body and blade are, measured or foretold.

#include "firmware/dozer/estimation/estimate.hpp"

namespace graben {

/// So much higher is the design below the body than on the track beside it.
[[nodiscard]] inline double raised_m(const DozerValid& valid, const DozerEstimates& estimates,
                                     double x_m) {
  return estimates.design.cross_at(x_m).slope * valid.course.offset_m;
}

/// As it is measured, over its track.
[[nodiscard]] Driving driving_of(const DozerModel& machine, const DozerValid& valid,
                                 const DozerEstimates& estimates);

/// `lead_s` after that, on its way to the speed that the last cycle asked for.
[[nodiscard]] Driving driven(const DozerModel& machine, const DozerValid& valid,
                             const DozerEstimates& estimates, const DozerLastCycle& last,
                             double lead_s);

/// Body and blade so long after the moment that the measured pose is of, having `driven` so far,
/// with this stroke; the blade's lift is left open.
[[nodiscard]] BladeSituation situation_of(const DozerModel& machine, const DozerValid& valid,
                                          const DozerEstimates& estimates, const Driving& driven,
                                          double lead_s, double stroke_m);

/// The same of the tilt.
[[nodiscard]] TiltSituation tilt_at(const DozerModel& machine, const BladeSituation& at,
                                    double stroke_m);

/// How much farther off the design than its middle an end of the edge is, by that error of its
/// slope.
[[nodiscard]] inline double at_ends_m(const DozerModel& machine, double cross_error) {
  return machine.profile.tilt.half_width_m() * std::abs(cross_error);
}

}  // namespace graben
