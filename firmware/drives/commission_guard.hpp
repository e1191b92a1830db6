// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Guards a drive whose valve is not known: duties are tried on it, open loop, and nothing that is
/// said of its spool but the dead time's and the lag's longest is relied on.

#include "firmware/core/fault_set.hpp"
#include "firmware/drives/drive_validation.hpp"
#include "firmware/drives/tuning.hpp"

namespace graben {

/// State of one drive from cycle to cycle.
struct CommissionState {
  bool begun = false;
  double stroke_m = 0.0;
  double slow_m = 0.0;                        ///< Stroke, low-passed.
  double speed_mps = 0.0;                     ///< Late by the same.
  double since_extend_s = kGuardUnderWay_s;   ///< Since the last duty that extends ...
  double since_retract_s = kGuardUnderWay_s;  ///< ... and that retracts; as long as it matters.
  /// Since both, beyond kGuardUnderWay_s; as long as it matters.
  double still_for_s = kGuardComesToRest_s;
  double wrong_m = 0.0;  ///< Gone against the duty.
  double free_m = 0.0;   ///< Gone without any.
  double whole_m = 0.0;  ///< The same as either, however slowly, since it counts.
  double cap_pa = 0.0;   ///< Low-passed ...
  double rod_pa = 0.0;
  double rest_cap_pa = 0.0;  ///< ... and before the duty began.
  double rest_rod_pa = 0.0;
  double still_m = 0.0;     ///< Stroke at its last change.
  double strained_s = 0.0;  ///< That it should have moved since then.
  double spent_s = 0.0;     ///< Duty times time since then.
  double pushed_s = 0.0;    ///< That pressures alone have said so, without a break.
  double most_ratio = 1.0;  ///< Of a duty while they do.
  double touches_s = 0.0;   ///< That it is pushed against an end.
  double duty_ratio = 0.0;  ///< Last one sent.
  double steady_s = 0.0;    ///< Since it last fell or changed sides.
  double from_m = 0.0;      ///< Stroke then.
  int held_side = 0;        ///< To which the window holds the drive back.
  bool was_inside = false;  ///< Its window, or near it, since it may move.
  /// Least duties that have moved it; kept for as long as the process runs.
  double moves_extend = 1.0;
  double moves_retract = 1.0;
};

/// What is tried in this cycle.
struct CommissionAsk {
  double sent_ratio = 0.0;    ///< Duty of the last cycle.
  double wanted_ratio = 0.0;  ///< Duty that is asked for now.
  StrokeWindow window;        ///< As constructed: none is confirmed.
  bool alone = true;          ///< No other drive is told to move.
};

struct CommissionResult {
  Fault fault = Fault::kNone;
  double duty_ratio = 0.0;  ///< What may be sent.
  bool held = false;        ///< Less than what is asked for, because of the window.
};

/// The window is one that the cylinder has, and allows motion.
[[nodiscard]] bool is_window(const DriveRow& drive, const StrokeWindow& window);

/// A cycle on.
///
/// Without a window the duty is 0. Where the drive is outside, or will be before it can be stopped,
/// it is 0 towards there until that is no longer asked for; the other way is free. An end of the
/// cylinder that the window reaches may be met slowly, and pushed against for kGuardTouch_s.
///
/// kCommissionBound: gone further outside than kGuardOutside_m, or faster than the window allows.
/// kWrongDirection: gone against its duty by 30 mm, since none of the other sign can be under way.
/// kUncommandedMotion: gone by 30 mm although nothing is under way and it has had time to come to
/// rest. What creeps at less than 6 mm/s is forgotten, a load that sinks while its spool is at its
/// edge, leakage; up to 45 mm for as long as this drive, or another, is told to move.
/// kStrokeStuck: stands still though it should move, for 0.4 s longer than that may take. It should
/// at a duty that opens any spool or has moved it before. What pressures alone say takes three
/// times as long: with what its pump gives on the side that is fed; while no other drive is told to
/// move, where both together have changed by 6 MPa. A side that has never moved may have a sensor
/// that hangs, and then goes on unseen: of it 3 MPa say so, it takes twice as long only, and
/// meanwhile the duty is held where it is, after 1 s it may rise by 3 % a second. A smaller duty
/// may be tried for 2 s over what it is above a tenth. The sensor hangs, or the cylinder.
[[nodiscard]] CommissionResult next_commission(const DriveRow& drive, const CommissionAsk& ask,
                                               const ValidDrive& seen, double period_s,
                                               CommissionState& state);

/// The same outside of motion: all but the least duties begins newly.
void rest_commission(CommissionState& state);

}  // namespace graben
