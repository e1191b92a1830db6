// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Fifth stage of a cycle: from what may be followed to what the valve and the pumps are sent.

#include "firmware/drives/drive_gate.hpp"
#include "firmware/drives/lead/spool_lead.hpp"
#include "firmware/excavator/limits/limits.hpp"
#include "firmware/excavator/outputs/pump_demand.hpp"

namespace graben {

/// Time constants of the spools that are led; 0 of one that is not.
using LedThrough = std::array<double, 2>;

/// State from cycle to cycle.
struct OutputState {
  std::array<double, kDriveCount> opening{};  ///< x / x_m at work.
  std::array<double, kDriveCount> sent{};     ///< Duties that the gate let through.
  std::array<LedSpool, 2> spool;
  LedThrough led_s{};
  PumpDemand pumps;
};

/// Duties without what leads the spools through their lag: where the watches look for them. And
/// what was added to lead them.
struct SentDuties {
  std::array<double, kDriveCount> duty_ratio{};
  std::array<double, kDriveCount> lead_ratio{};
};

/// Enable, duties and swash of this cycle; the gate comes last. A refusal of it stops: it changes
/// `decision`.
[[nodiscard]] SentDuties put_out(const ExcavatorModel& machine, const ExcavatorValid& valid,
                                 const InputState& inputs, const EstimationState& estimates,
                                 const Motion& motion, const LimitState& limits,
                                 const Followed& followed, const Cycle& cycle,
                                 const LastCycle& last, ModeDecision& decision, OutputState& state,
                                 ExcavatorOutputs& outputs);

}  // namespace graben
