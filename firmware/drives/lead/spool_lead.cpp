// SPDX-License-Identifier: Apache-2.0
#include "firmware/drives/lead/spool_lead.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/core/time.hpp"
#include "firmware/drives/lead/tuning.hpp"

namespace graben {
namespace {

/// The model after a time at a constant duty.
SpoolModel after(const SpoolModel& spool, double time_constant_s, double duty_ratio,
                 double time_s) {
  const double omega_ps = 1.0 / time_constant_s;
  const double missing = spool.travel_ratio - duty_ratio;
  const double slope = spool.speed_ps + omega_ps * missing;
  const double left = std::exp(-omega_ps * time_s);
  return {duty_ratio + (missing + slope * time_s) * left,
          (slope - omega_ps * (missing + slope * time_s)) * left};
}

/// 1: it goes as its model does; 0: it does not.
double trust(const LedSpool& spool) {
  const double off = spool.missed / (spool.gone + kLeadStill);
  return std::clamp((kLeadGivenUp - off) / (kLeadGivenUp - kLeadDoubted), 0.0, 1.0);
}

}  // namespace

double led_duty(double time_constant_s, double wanted_ratio, const SpoolModel& spool) {
  if (!(time_constant_s > 0.0)) {
    return wanted_ratio;
  }
  // Sooner than within its time constant a spool takes many times the way that it is to go.
  const double ahead_s = std::max(kLeadAhead_s, time_constant_s);
  const double by_itself = after(spool, time_constant_s, 0.0, ahead_s).travel_ratio;
  const double by_duty = after(spool, time_constant_s, 1.0, ahead_s).travel_ratio - by_itself;
  const double leading = std::clamp((wanted_ratio - by_itself) / by_duty, -1.0, 1.0);
  // To neutral it comes at last, not ever nearer.
  return wanted_ratio == 0.0 && std::abs(leading) < kLeadHome ? 0.0 : leading;
}

SpoolModel spool_after(double time_constant_s, double sent_ratio, const SpoolModel& spool) {
  return time_constant_s > 0.0 ? after(spool, time_constant_s, sent_ratio, kCyclePeriod_s)
                               : SpoolModel{sent_ratio, 0.0};
}

double trusted_lead(double time_constant_s, double wanted_ratio, const LedSpool& spool) {
  const double leading = led_duty(time_constant_s, wanted_ratio, spool.model) - wanted_ratio;
  return wanted_ratio + trust(spool) * std::clamp(leading, -kLeadMost, kLeadMost);
}

void next_led(double time_constant_s, double sent_ratio, LedSpool& spool) {
  spool.last = spool.model;
  spool.model = spool_after(time_constant_s, sent_ratio, spool.model);
}

void judge_model(double time_constant_s, double measured_ratio, LedSpool& spool) {
  const double newest = kCyclePeriod_s / kLeadJudged_s;
  const double missed = measured_ratio - spool.last.travel_ratio;
  const double gone = time_constant_s * spool.last.speed_ps;
  spool.missed += newest * (missed * missed - spool.missed);
  spool.gone += newest * (gone * gone - spool.gone);
}

}  // namespace graben
