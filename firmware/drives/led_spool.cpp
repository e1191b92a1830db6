// SPDX-License-Identifier: Apache-2.0
#include "firmware/drives/led_spool.hpp"

#include <algorithm>

#include "firmware/core/time.hpp"
#include "firmware/drives/tuning.hpp"

namespace graben {
namespace {

/// 1: it goes as its model does; 0: it does not.
double trust(const LedSpool& spool) {
  const double off = spool.missed / (spool.gone + kLeadStill);
  return std::clamp((kLeadGivenUp - off) / (kLeadGivenUp - kLeadDoubted), 0.0, 1.0);
}

}  // namespace

double trusted_lead(double time_constant_s, double wanted_ratio, const LedSpool& spool) {
  const double leading = led_duty(time_constant_s, wanted_ratio, spool.model) - wanted_ratio;
  return wanted_ratio + trust(spool) * std::clamp(kLeadShare * leading, -kLeadMost, kLeadMost);
}

void next_led(double time_constant_s, double sent_ratio, LedSpool& spool) {
  spool.last = spool.model;
  spool.model = spool_after(time_constant_s, sent_ratio, spool.model);
}

void judge_model(double time_constant_s, double measured_ratio, LedSpool& spool) {
  constexpr double kNewest = kCyclePeriod_s / kLeadJudged_s;
  const double missed = measured_ratio - spool.last.travel_ratio;
  const double gone = time_constant_s * spool.last.speed_ps;
  spool.missed += kNewest * (missed * missed - spool.missed);
  spool.gone += kNewest * (gone * gone - spool.gone);
}

void rest_led(LedSpool& spool) {
  spool.model = {};
  spool.last = {};
}

}  // namespace graben
