#pragma once
/// Feedback around the valve's model: what the drives should have done by now, what is still under
/// way to them, and what they owe. What is said of a cylinder holds for the swing's travel too.

#include <array>

#include "firmware/excavator/excavator_profile.hpp"

namespace graben {

/// What one cycle hands to the next; as constructed, a machine at rest at strokes 0.
struct ServoState {
  static constexpr int kMostDelayed = 64;   ///< Cycles of dead time that can be remembered.
  static constexpr double kCycle_s = 0.01;  ///< What a place of the ring stands for.

  ServoState() { asked_mps.fill(DriveVector::Zero()); }

  std::array<DriveVector, kMostDelayed> asked_mps;  ///< Ring of the last commands.
  int newest = 0;
  std::array<DriveVector, 2> lag_mps = {DriveVector::Zero(), DriveVector::Zero()};
  /// Asked for, not yet due: what the ring and the lags still hold, so that nothing adds up.
  DriveVector under_way_m = DriveVector::Zero();
  DriveVector owed_m = DriveVector::Zero();     ///< Due, not yet seen.
  DriveVector repay_m = DriveVector::Zero();    ///< Behind its low-pass: what is asked for.
  DriveVector repay_mps = DriveVector::Zero();  ///< Its rate of change.
  DriveVector trim_mps = DriveVector::Zero();   ///< What has been learnt to be always missing.
  DriveVector strokes_m = DriveVector::Zero();  ///< Measured.
};

/// Nothing is under way, nothing is owed.
[[nodiscard]] ServoState servo_at_rest(const DriveVector& strokes_m);

/// State after a cycle that asked for `asked_mps` (lambda V_L^d, without corrections), seen from
/// the next one, `period_s` later, with these strokes.
///
/// A cylinder is expected to answer after `dead_time_s` with two lags of half `response_s` each.
/// What it should have moved by then and has not is owed: the integral of the error of its speed,
/// where lambda has already slowed what is expected, so that nothing winds up while a limit holds.
/// Bounded by `servo_most_m`, for a cylinder that something else holds.
///
/// It is asked for behind a second-order low-pass (`servo_frequency_hz`, `servo_damping`). A load
/// that shakes the linkage on its oil makes every cylinder owe and be owed by turns; answered at
/// once, that arrives `response_s` late and feeds the motion. A low-pass just below the lowest mode
/// turns it on by a quarter of a period and more: there it takes energy out, and what changes
/// slowly passes as it is.
[[nodiscard]] ServoState next_servo(const ControlProfile& control, const ServoState& last,
                                    const DriveVector& asked_mps, const DriveVector& strokes_m,
                                    double period_s);

/// The same where a plan says what the drives owe: `planned_m` is the travel that it has asked for
/// until now. No sum of errors, so nothing is forgotten and nothing adds up over a long task. What
/// a drive goes on owing is learnt (`line.trim_ps2`) and asked for on top: a motor leaks, and a
/// line in space is as straight as its slowest drive. A new plan has other lags, and learns them
/// anew.
[[nodiscard]] ServoState next_servo_on_plan(const ExcavatorProfile& profile, const ServoState& last,
                                            const DriveVector& asked_mps,
                                            const DriveVector& strokes_m,
                                            const DriveVector& planned_m, bool new_plan,
                                            double period_s);

/// Where the cylinders will be when what is under way has arrived, within their strokes: where the
/// field has to be asked, so that neither lag nor dead time carries the bucket past a bend.
[[nodiscard]] DriveVector strokes_then(const ExcavatorProfile& profile, const ServoState& servo);

/// Nothing is asked for any more, but what is under way still arrives; it owes nothing.
[[nodiscard]] ServoState servo_released(const ControlProfile& control, const ServoState& last,
                                        const DriveVector& strokes_m, double period_s);

/// The wanted velocity with what is owed, in the ratio of the operator's speed; at rest where none
/// is wanted. What is owed never pushes a cylinder faster at its end than `stroke_end_gain_ps`
/// allows: it must not stop the others there. A swing of which nothing is wanted keeps its spool
/// closed, whatever it owes: its motor holds it. All that is asked of the valve scales with lambda;
/// so that this does not turn the direction, what is owed is raised as lambda falls, down to
/// `servo_least_lambda`. The swing has a gain of its own, `swing_servo_gain_ps`.
/// Where `holds`, drives that are wanted to stand are corrected too.
[[nodiscard]] DriveVector corrected_velocity(const ExcavatorProfile& profile,
                                             const DriveVector& wanted_mps, const ServoState& servo,
                                             double last_lambda, double speed_override_ratio,
                                             bool holds = false);

}  // namespace graben
