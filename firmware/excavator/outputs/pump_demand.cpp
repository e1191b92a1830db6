// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/outputs/pump_demand.hpp"

#include <algorithm>

#include "firmware/excavator/outputs/tuning.hpp"
#include "firmware/hydraulics/flow.hpp"
#include "firmware/mcv/pump_need.hpp"

namespace graben {
namespace {

/// Takes from all pumps alike what is more than the engine can give.
void keep_within_power(const SwashRange& range, const PerPump<double>& full_m3ps,
                       const PerPump<double>& line_pa, Span<double> swash_ratio) {
  double power_w = 0.0;
  for (int j = 0; j < swash_ratio.count(); ++j) {
    const auto k = static_cast<unsigned>(j);
    power_w += swash_ratio[j] * full_m3ps[k] * line_pa[k];
  }
  if (power_w > range.most_power_w) {
    for (double& swash : swash_ratio) {
      swash = std::max(swash * (range.most_power_w / power_w), range.least_ratio);
    }
  }
}

}  // namespace

void next_pump_demand(const ExcavatorProfile& profile, const McvMachine& valve, const PumpAsk& ask,
                      double period_s, PumpDemand& demand) {
  if (!ask.active || !(profile.demand_swash.most_ratio > 0.0)) {
    demand.swash_ratio = profile.dig_swash_ratio;
    demand.short_ratio = {};
    return;
  }
  double most_pa = profile.pump[0].relief_pa;
  for (int j = 1; j < profile.pump_count; ++j) {
    most_pa = std::min(most_pa, profile.pump[static_cast<unsigned>(j)].relief_pa);
  }
  const PerPump<double> flow_m3ps =
      needed_flow_m3ps(valve, ask.input,
                       {1.0, ask.reserve_ratio * profile.control.lambda_rise.reserve_n,
                        kPumpLoadShare, kPumpReliefShare * most_pa});
  const double turning_radps = std::max(ask.engine_radps, profile.safety.idle_radps);
  PerPump<double> full_m3ps{};
  const double down_ps = ask.blocked ? kSwashUp_ps : kSwashDown_ps;
  for (unsigned j = 0; j < static_cast<unsigned>(profile.pump_count); ++j) {
    full_m3ps[j] = pump_flow_m3ps(profile.pump[j], turning_radps, 1.0);
    const double most_ratio =
        ask.blocked ? std::min(profile.dig_swash_ratio[j], profile.demand_swash.most_ratio)
                    : profile.demand_swash.most_ratio;
    double& lacks = demand.short_ratio[j];
    const double short_of = std::max(0.0, ask.short_share[j] - kShortFrom);
    lacks =
        std::clamp(lacks + period_s * (kShortUp_ps * short_of - kShortDown_ps), 0.0, kShortMost);
    if (ask.blocked) {
      lacks = 0.0;  // More oil only throws the tool further when its load gives way.
    }
    const double wanted =
        std::min(std::max(flow_m3ps[j] / full_m3ps[j], profile.demand_swash.least_ratio) + lacks,
                 most_ratio);
    double& swash = demand.swash_ratio[j];
    swash = std::clamp(swash, profile.demand_swash.least_ratio, profile.demand_swash.most_ratio);
    swash = std::clamp(wanted, swash - down_ps * period_s, swash + kSwashUp_ps * period_s);
  }
  keep_within_power(profile.demand_swash, full_m3ps, ask.line_pa,
                    {demand.swash_ratio.data(), profile.pump_count});
}

}  // namespace graben
