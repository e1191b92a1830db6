// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The excavator's drives as a bank: boom, arm and bucket with their cylinders, and the swing where
/// the machine has one.

#include <array>

#include "firmware/drives/drive_servo.hpp"
#include "firmware/excavator/excavator_profile.hpp"
#include "firmware/mcv/mcv_machine.hpp"

namespace graben {

using ExcavatorBank = DriveBank<kDriveCount>;

/// Made once, at start.
[[nodiscard]] ExcavatorBank excavator_bank(const ExcavatorProfile& profile);

/// The valve as the optimiser's table, actuators in the order of the drives.
[[nodiscard]] McvMachine mcv_machine(const ExcavatorProfile& profile);

/// How a side of a drive's spool answers: what the profile says of it, else what it says of the
/// whole valve.
[[nodiscard]] SpoolAnswer answer_of(const ExcavatorProfile& profile, int drive, bool extends);

/// The row's share of valve section, control and watches, alike for every drive.
[[nodiscard]] DriveRow section_row(const ExcavatorProfile& profile, int drive);

/// Largest flow that reaches a drive, m^3/s: its section's flow, or its pump's whole flow if that
/// is less.
[[nodiscard]] double most_flow_m3ps(const ExcavatorProfile& profile, int drive);

/// Faster than this a row with spool and areas never moves, m/s.
[[nodiscard]] double fastest_mps(const ExcavatorProfile& profile, const DriveRow& row);

/// Boom and arm answer in time for a feedback of the oil's state (oil_law.hpp): later than 50 ms,
/// lagging more than 100 ms or by spools that are not led, what is fed back comes too late, and the
/// servo's expectation is better.
[[nodiscard]] bool are_quick(DriveRows drives);

/// Servos of the drives; those that the machine does not have stay at rest at 0.
struct ExcavatorServo {
  std::array<ServoState, kDriveCount> drive;

  [[nodiscard]] DriveVector strokes_m() const;
  [[nodiscard]] DriveVector under_way_m() const;
};

/// See stroke_then_m().
[[nodiscard]] DriveVector strokes_then_m(DriveRows drives, const ExcavatorServo& servo);

/// Where all drives will be when a command of now to one of them (`drive`) takes effect, by its
/// dead time and lag. What the others are asked for by then is not known yet: taken for
/// `asked_mps`, that of now. x_j = x_j,then + (T_drive - T_j) asked_j. Where all answer alike it is
/// strokes_then_m(); where not, that is a pose that no drive ever sees: one early, another late.
[[nodiscard]] DriveVector strokes_when_m(DriveRows drives, const ExcavatorServo& servo,
                                         const DriveVector& asked_mps, int drive);

/// V_L^d with the corrections of all drives, see corrected_mps(); at rest where none is wanted to
/// move. Where `hold`, drives that are wanted to stand are corrected too.
[[nodiscard]] DriveVector corrected_velocity(DriveRows drives, const DriveVector& wanted_mps,
                                             const ExcavatorServo& servo, double last_lambda,
                                             double speed_override_ratio, bool hold = false);

/// One value a drive, of a vector.
[[nodiscard]] inline Span<const double> span_of(const DriveVector& values) {
  return {values.data(), kDriveCount};
}

}  // namespace graben
