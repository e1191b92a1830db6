// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A drive's sensor against the oil that its spool lets through: the measured opening and the
/// pressures, with what is not known of them, bound the travel of every moment.

#include "firmware/core/fault_set.hpp"
#include "firmware/drives/drive_validation.hpp"
#include "firmware/drives/flow_speed.hpp"
#include "firmware/drives/learnt/learnt_valve.hpp"

namespace graben {

/// Where a spool that is told by its pilot pressure may be: within all that was told in the last
/// `spool_late_s`, and no further back than twice that.
struct SpoolSpan {
  double low = 0.0;
  double high = 0.0;
  double last_low = 0.0;
  double last_high = 0.0;
  double for_s = 0.0;  ///< That `low` and `high` have been gathered.
};

/// State of one drive from cycle to cycle.
struct FlowState {
  bool begun = false;
  int same_cycles = 0;  ///< In a row that a side has shown the same pressure.
  double cap_shown_pa = 0.0;
  double rod_shown_pa = 0.0;
  double stroke_m = 0.0;
  double cap_pa = 0.0;  ///< Low-passed.
  double rod_pa = 0.0;
  SpoolSpan told;          ///< Read of a spool that is not measured.
  SpeedRange last;         ///< Of the last cycle: a spool's frame comes every second one.
  double least_m = 0.0;    ///< Least travel since the last stroke that was received ...
  double most_m = 0.0;     ///< ... and most.
  double behind_m = 0.0;   ///< That the stroke fell short of the least, so far.
  double ahead_m = 0.0;    ///< That it went beyond the most.
  double still_m = 0.0;    ///< Stroke at its last change.
  double extend_m = 0.0;   ///< Least travel since then, one way ...
  double retract_m = 0.0;  ///< ... and the other.
};

/// kStrokeStuck: the stroke stands still while its oil moves the drive by at least `unseen_m`.
/// kMotionImplausible: it is off by `off_m` from all that its oil can have done: another drive's
/// sensor, one that drifts, a valve that is not the profile's.
///
/// Travel that the oil's and the hoses' stiffness (0.6 to 2 GPa) gives or takes is counted in. What
/// is within the bounds wears the difference off, and 10 s are its time constant: leakage is no
/// drift. A spool told by its pilot pressure comes after it: all that it was told of late bounds
/// the travel. Neither a drive without measured spool nor one whose pressures are not known, stand
/// still to the last bit, step or are near their rail is checked, for as long as that lasts: what
/// it was off before stays. `learnt` is empty where no valve is.
[[nodiscard]] FaultSet watch_flow(DriveRows drives, Span<const ValidDrive> seen,
                                  Span<const LearntValve> learnt, double engine_radps,
                                  double period_s, Span<FlowState> state);

}  // namespace graben
