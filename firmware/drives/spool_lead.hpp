// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Lead through a spool's own lag.

namespace graben {

/// A spool as it is modelled: critically damped, of the second order. At rest in the middle as
/// constructed.
struct SpoolModel {
  double travel_ratio = 0.0;
  double speed_ps = 0.0;
};

/// The duty, -1 .. 1, that takes the modelled spool to `wanted_ratio` within two cycles (20 ms), or
/// within its time constant if that is longer, if it is kept up. A time constant of 0 leads
/// nothing.
[[nodiscard]] double led_duty(double time_constant_s, double wanted_ratio, const SpoolModel& spool);

/// The model a cycle on, with the duty that was sent; with a time constant of 0 it is there.
[[nodiscard]] SpoolModel spool_after(double time_constant_s, double sent_ratio,
                                     const SpoolModel& spool);

}  // namespace graben
