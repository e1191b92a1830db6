// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The swing among the excavator's drives: where a motor on one of the valve's sections turns the
/// platform, it is one more row. Angles in rad, to the left positive; travels are those at
/// SwingProfile::lever_m.

#include "firmware/drives/drive_validation.hpp"
#include "firmware/excavator/excavator_profile.hpp"
#include "firmware/machine/drive_bank.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben {

[[nodiscard]] inline double swing_of(const DriveVector& drives) { return drives[kSwing]; }

[[nodiscard]] inline DriveVector with_swing(const DriveVector& drives, double swing) {
  DriveVector changed = drives;
  changed[kSwing] = swing;
  return changed;
}

/// Strokes and swing angle as travels, and back. Without a swing drive its part is 0.
[[nodiscard]] DriveVector travel_of(const ExcavatorProfile& profile, const DriveVector& drives);
[[nodiscard]] DriveVector drives_of(const ExcavatorProfile& profile, const DriveVector& travel_m);

/// The swing's row: equal areas, no end stops, a mass that takes time to stop.
[[nodiscard]] DriveRow swing_row(const ExcavatorProfile& profile);

/// The swing's signals as those of a drive, extending to the left.
[[nodiscard]] DriveInputs swing_inputs(const SwingInputs& swing, const SwingProfile& profile);

/// Speed to be asked of the swing beyond `wanted_mps` so that its platform is as fast by then:
/// its lag (control.swing_lead_s) times the change of what is wanted, as far as the platform can
/// follow that at all.
[[nodiscard]] double swing_lead_mps(const ExcavatorProfile& profile, double wanted_mps,
                                    double last_wanted_mps, double period_s);

/// What the swing's two sides push the platform with, left less right, low-passed; as constructed
/// nothing is known. A pressure that is missing for less than kSwingPushSlow_s leaves the slow one
/// as it was: of friction, slope and zeros nothing has changed.
struct SwingPush {
  bool known = false;  ///< Now.
  double fast_pa = 0.0;
  double slow_pa = 0.0;         ///< With friction, slope and the sensors' zeros.
  double unseen_s = kInfinity;  ///< So long it has not been known.
};
void next_swing_push(const ValidDrive& swing, double period_s, SwingPush& push);

/// Speed that damps the platform on its oil: as it is pushed it is accelerated, and what that is
/// more than the plan's acceleration is taken back over swing_lead_s. 0 where the platform's
/// inertia or its pressures are not known.
[[nodiscard]] double swing_damping_mps(const ExcavatorProfile& profile, const SwingPush& push);

/// Largest speed of the swing, rad/s: its own limit, or what the flow that reaches it gives its
/// motor.
[[nodiscard]] double swing_speed_max_radps(const ExcavatorProfile& profile);

}  // namespace graben
