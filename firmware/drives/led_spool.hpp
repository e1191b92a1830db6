// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A spool that is led through its lag, and how far its model is trusted: where the measured spool
/// goes otherwise, because it is slower, later, or slower on one way than on the other, the lead
/// would only drive it beyond.

#include "firmware/drives/spool_lead.hpp"

namespace graben {

/// State from cycle to cycle.
struct LedSpool {
  SpoolModel model;
  SpoolModel last;      ///< A cycle ago: a measured spool is about so old.
  double missed = 0.0;  ///< Square of where the measured spool is from that, low-passed.
  double gone = 0.0;    ///< The same of the way that the model goes within its time constant.
};

/// The duty for `wanted_ratio`: a share of the lead, bounded, as far as the model is trusted.
[[nodiscard]] double trusted_lead(double time_constant_s, double wanted_ratio,
                                  const LedSpool& spool);

/// The spool a cycle on, with the duty that was sent.
void next_led(double time_constant_s, double sent_ratio, LedSpool& spool);

/// Compares with where it is measured, before `next_led` of the cycle.
void judge_model(double time_constant_s, double measured_ratio, LedSpool& spool);

/// Not led: its model begins anew at rest; what was learnt of it stays.
void rest_led(LedSpool& spool);

}  // namespace graben
