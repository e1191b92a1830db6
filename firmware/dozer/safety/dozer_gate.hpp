#pragma once
/// The dozer's last gate before the bus: what it lets through is finite, in range, rate-limited and
/// enabled, whatever computed it.

#include <array>

#include "firmware/core/guarded.hpp"
#include "firmware/dozer/dozer_profile.hpp"

namespace graben {

/// What is wanted of blade and transmission.
struct DozerCommand {
  double opening = 0.0;  ///< -1 .. 1 of valve_flow_max; extension is positive.
  std::array<double, kTrackCount> pump_ratio{};
  std::array<double, kTrackCount> motor_ratio = {1.0, 1.0};
};

/// What the gate let through in the last cycle.
struct DozerGateState {
  Guarded<double> opening;
  std::array<Guarded<double>, kTrackCount> pump_ratio;
  std::array<Guarded<double>, kTrackCount> motor_ratio = {Guarded(1.0), Guarded(1.0)};
};

struct DozerGateResult {
  bool enable = false;
  Fault fault = Fault::kNone;  ///< kCommandNotFinite or kMemoryCorrupt when it had to refuse.
  double duty_ratio = 0.0;     ///< Of the blade's spool, -1 .. 1.
  std::array<double, kTrackCount> pump_ratio{};              ///< -1 .. 1
  std::array<double, kTrackCount> motor_ratio = {1.0, 1.0};  ///< motor_ratio_min .. 1
  DozerGateState state;
};

/// Not active, or any setpoint not finite, or one that is stored and differs from its complement:
/// neutral in this cycle, enable withdrawn. Neutral is a closed spool, pumps at 0, motors at 1.
/// Otherwise each setpoint is clamped into its range, and what makes the machine faster is limited
/// in its rate: an opening away from 0 by spool_rate_ps, a pump away from 0 by pump_rate_ps, a
/// motor down from 1 by motor_rate_ps. The way back is never delayed; a reversal begins at 0. Below
/// spool_threshold the spool is kept at neutral; its duty follows spool_to_duty. `period_s` is the
/// time since the last cycle.
[[nodiscard]] DozerGateResult gate(const DozerProfile& profile, const DozerGateState& last,
                                   bool active, const DozerCommand& wanted, double period_s);

}  // namespace graben
