// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The dozer's last gate before the bus: what it lets through is finite, in range, rate-limited and
/// enabled, whatever computed it.

#include <array>

#include "firmware/dozer/blade.hpp"
#include "firmware/drives/drive_gate.hpp"

namespace graben {

/// Setpoints of blade and transmission.
struct DozerCommand {
  /// Lift and tilt, -1 .. 1 of their valve's flow; extension is positive.
  std::array<double, kBladeCount> opening{};
  std::array<double, kTrackCount> pump_ratio{};
  std::array<double, kTrackCount> motor_ratio = {1.0, 1.0};
  bool tries = false;                             ///< `tried_ratio` in the place of openings.
  std::array<double, kBladeCount> tried_ratio{};  ///< Duties, -1 .. 1.
};

/// Setpoints that the gate let through in the last cycle, and the openings that the duties are of.
struct DozerGateState {
  std::array<double, kBladeCount> opening{};
  std::array<double, kBladeCount> duty_ratio{};
  std::array<double, kTrackCount> pump_ratio{};
  std::array<double, kTrackCount> motor_ratio = {1.0, 1.0};
};

/// Commands that may go to the bus; as constructed, neutral.
struct DozerGateResult {
  bool enable = false;
  Fault fault = Fault::kNone;                    ///< kCommandNotFinite when it had to refuse.
  std::array<double, kBladeCount> duty_ratio{};  ///< Of each spool, -1 .. 1.
  std::array<double, kTrackCount> pump_ratio{};  ///< -1 .. 1
  std::array<double, kTrackCount> motor_ratio = {1.0, 1.0};  ///< motor_ratio_min .. 1
};

/// Not active, or any setpoint not finite: neutral in this cycle, enable withdrawn. Neutral is a
/// closed spool, pumps at 0, motors at 1. Otherwise each setpoint is clamped into its range, and
/// what makes the machine faster is limited in its rate: a pump away from 0 by pump_rate_ps, a
/// motor down from 1 by motor_rate_ps, the blade as open_spools() (of duties that are tried as
/// step_duties()) and gate_duties() have it. The
/// way back is never delayed; a reversal begins at 0. `period_s` is the time since the last cycle;
/// `state` goes on by a cycle.
[[nodiscard]] DozerGateResult gate_dozer(const DozerProfile& profile, DriveRows drives, bool active,
                                         const DozerCommand& wanted, double period_s,
                                         DozerGateState& state);

}  // namespace graben
