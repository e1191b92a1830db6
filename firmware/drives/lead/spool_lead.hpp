// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Lead through a spool's own lag, and how far its model is trusted: where the measured spool goes
/// otherwise, because it is slower, later, or slower on one way than on the other, the lead would
/// only drive it beyond.

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

/// State from cycle to cycle.
struct LedSpool {
  SpoolModel model;
  SpoolModel last;      ///< A cycle ago: a measured spool is about so old.
  double missed = 0.0;  ///< Square of where the measured spool is from that, low-passed.
  double gone = 0.0;    ///< The same of the way that the model goes within its time constant.
};

/// The duty for `wanted_ratio`: the lead, as far as the model is trusted.
[[nodiscard]] double trusted_lead(double time_constant_s, double wanted_ratio,
                                  const LedSpool& spool);

/// The spool a cycle on, with the duty that was sent.
void next_led(double time_constant_s, double sent_ratio, LedSpool& spool);

/// Compares with where it is measured, before `next_led` of the cycle.
void judge_model(double time_constant_s, double measured_ratio, LedSpool& spool);

}  // namespace graben
