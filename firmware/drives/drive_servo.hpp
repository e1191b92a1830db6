// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Feedback around the valve's model: what each drive should have done by now, what is still under
/// way to it, and how far it is behind; and the load as that model compensates it.

#include <array>

#include "firmware/core/time.hpp"
#include "firmware/drives/drive_validation.hpp"

namespace graben {

/// State from cycle to cycle, of one drive; as constructed, at rest at stroke 0.
struct ServoState {
  /// Cycles of dead time that can be remembered. [cycles; size: ring of the last commands, 0.64 s]
  static constexpr int kMostDelayed = 64;

  std::array<double, kMostDelayed> asked_mps{};  ///< Ring of the last commands.
  int newest = 0;
  /// Two lags of each side; where both have the same times, the first pair is that of both.
  std::array<std::array<double, 2>, 2> lag_mps{};
  /// Asked for, not yet due: what the ring and the lags still hold, so that nothing adds up.
  double under_way_m = 0.0;
  double integral_m = 0.0;      ///< Due, not yet seen: the integrated error of the speed.
  double correction_m = 0.0;    ///< The integral behind its low-pass: what is asked for.
  double correction_mps = 0.0;  ///< Its rate of change.
  double bias_mps = 0.0;        ///< Learnt: what is always missing.
  double stroke_m = 0.0;        ///< Measured.
};

/// At rest at this stroke: nothing is under way, nothing is behind.
void servo_at_rest(double stroke_m, ServoState& servo);

/// A cycle on, after one that asked for `asked_mps` (lambda V_L^d, without corrections), seen from
/// the next one, `period_s` later, with this stroke.
///
/// A drive is expected to answer after the dead time with two lags of half its lag each, to either
/// side with that side's (SpoolAnswer). What it should have moved by then and has not is
/// integrated, where lambda has already slowed what is expected, so that nothing winds up while a
/// limit holds. Bounded by `error_most_m`, for a drive that something else holds.
///
/// The integral is asked for behind a second-order low-pass (`frequency_hz`, `damping`). A load
/// that shakes the linkage on its oil puts every drive behind and ahead by turns; answered at once,
/// that arrives late and feeds the motion. A low-pass just below the lowest mode turns
/// it on by a quarter of a period and more: there it takes energy out, and what changes slowly
/// passes as it is.
///
/// A drive that its load holds (`blocked_side`, +1 against extension) owes nothing to that side:
/// what it is behind is not added, and what was is forgotten with a time constant of 0.3 s.
void next_servo(const DriveRow& drive, double asked_mps, double stroke_m, double period_s,
                ServoState& servo, int blocked_side = 0);

/// The same where a plan says how far the drive is behind: `planned_m` is the travel that it has
/// asked for until now. No sum of errors, so nothing is forgotten and nothing adds up over a long
/// task. A lag that lasts is learnt (`bias_ps2`) and asked for on top: a motor leaks, and a line in
/// space is as straight as its slowest drive. A new plan has other lags, and learns them newly.
void next_servo_on_plan(const DriveRow& drive, double asked_mps, double stroke_m, double planned_m,
                        bool new_plan, double period_s, ServoState& servo, int blocked_side = 0);

/// Nothing is asked for any more, but what is under way still arrives; nothing is behind.
void release_servo(const DriveRow& drive, double stroke_m, double period_s, ServoState& servo);

/// A cycle on after one in `mode`: next_servo() where it was Active, at rest after a fault, else
/// released.
void servo_after(const DriveRow& drive, EcuMode mode, double asked_mps, double stroke_m,
                 double period_s, ServoState& servo, int blocked_side = 0);

/// What the drive should do now, by what was asked of it.
[[nodiscard]] double due_mps(const ServoState& servo);

/// Where the drive will be when what is under way has arrived, within its end stops: where a field
/// has to be asked, so that neither lag nor dead time carries the machine past a bend. Where
/// nothing stops a drive at its end, one that is beyond is seen there.
[[nodiscard]] double stroke_then_m(const DriveRow& drive, const ServoState& servo);

/// The wanted velocity with correction and bias, in the ratio of the operator's speed; the
/// correction never pushes a drive faster at its end than `stroke_end_gain_ps` allows: it must not
/// stop the others there. All that is asked of the valve scales with lambda; so that this does not
/// turn the direction, the correction is raised as lambda falls, down to `least_lambda`. Unless it
/// is to `hold`, a drive that holds itself and of which nothing is wanted keeps its spool closed.
[[nodiscard]] double corrected_mps(const DriveRow& drive, const ServoState& servo,
                                   double wanted_mps, double last_lambda,
                                   double speed_override_ratio, bool hold);

/// The wanted velocity with this correction, bounded and raised as in corrected_mps().
[[nodiscard]] double corrected_by(const DriveRow& drive, const ServoState& servo, double wanted_mps,
                                  double correction_mps, double last_lambda);

/// A drive's load as the valve's model compensates it.
struct LoadState {
  double cap_pa = 0.0;
  double rod_pa = 0.0;
};

/// Chamber pressures through a first-order low-pass of `pressure_filter_s`; `restart` begins it at
/// what is measured. A drive whose load is not known keeps its last one. Oil columns are damped by
/// orifices that give way to pressure; a spool that answers every change of load at once takes that
/// damping away, one that answers slower than the machine's lowest mode leaves it. It takes most of
/// the transducers' noise out as well.
void next_loads(double pressure_filter_s, Span<const ValidDrive> seen, double period_s,
                bool restart, Span<LoadState> load);

}  // namespace graben
