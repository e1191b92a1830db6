// SPDX-License-Identifier: Apache-2.0
#pragma once
/// One cycle of the parts of the excavator's bank of drives, in values: the last state goes in, the
/// next one comes out beside the result.

#include "firmware/drives/drive_gate.hpp"
#include "firmware/drives/drive_watch.hpp"
#include "firmware/drives/velocity_cap.hpp"
#include "firmware/excavator/excavator_drives.hpp"
#include "firmware/excavator/safety/excavator_validation.hpp"

namespace graben::test {

struct GateState {
  std::array<double, kDriveCount> opening{};
  std::array<double, kDriveCount> sent{};
};

struct Gated : GateResult {
  std::array<double, kDriveCount> duty_ratio{};
  GateState state;
};

inline Gated gate(const ExcavatorProfile& profile, const GateState& last, bool active,
                  const std::array<double, kDriveCount>& spool_m, double period_s) {
  const ExcavatorBank bank = excavator_bank(profile);
  Gated gated;
  gated.state = last;
  gated.duty_ratio.fill(9.0);
  // A drive that the machine does not have: nothing is written there unless all is neutral.
  for (int i = bank.count; i < kDriveCount; ++i) {
    gated.duty_ratio[static_cast<unsigned>(i)] = 0.0;
  }
  std::array<double, kDriveCount> wanted_ratio{};
  open_spools(bank.rows(), spool_m, period_s, gated.state.opening, wanted_ratio);
  static_cast<GateResult&>(gated) =
      gate_duties(bank.rows(), active, wanted_ratio, period_s, gated.state.sent, gated.duty_ratio);
  return gated;
}

using StrokesAccepted = std::array<AcceptedStroke, kDriveCount>;

struct Validated : ExcavatorValid {
  StrokesAccepted state;
};

inline Validated validate(const ExcavatorInputs& inputs, const ExcavatorProfile& profile,
                          const StrokesAccepted& last, bool moving, TimeUs now_us) {
  const ExcavatorBank bank = excavator_bank(profile);
  Validated valid;
  valid.state = last;
  static_cast<ExcavatorValid&>(valid) =
      graben::validate(profile, bank.rows(), inputs, moving, now_us, valid.state);
  return valid;
}

/// State of the watches of spools and echo.
struct SpoolWatch {
  std::array<SpoolState, kDriveCount> spool;
  int echo_cycles = 0;
};

inline FaultSet watch_spools(const ExcavatorProfile& profile, SpoolWatch& state,
                             const LastCommands<kDriveCount>& sent, const ExcavatorValid& valid) {
  const ExcavatorBank bank = excavator_bank(profile);
  return graben::watch_spools(
      bank.rows(), DriveCommands(sent).sent, valid.drive,
      {!valid.faults.has(Fault::kSpoolMissing), profile.bus.valve_echo, valid.valve_enabled},
      state.spool, state.echo_cycles);
}

inline bool spools_centred(const ExcavatorProfile& profile, const ExcavatorValid& valid) {
  return graben::spools_centred(excavator_bank(profile).rows(), valid.drive);
}

inline ExcavatorServo servo_at_rest(const DriveVector& strokes_m) {
  ExcavatorServo servo;
  for (unsigned i = 0; i < kDriveCount; ++i) {
    graben::servo_at_rest(strokes_m[i], servo.drive[i]);
  }
  return servo;
}

/// One value of each servo; and the same set.
inline DriveVector of(const ExcavatorServo& servo, double ServoState::*value) {
  return {servo.drive[0].*value, servo.drive[1].*value, servo.drive[2].*value,
          servo.drive[3].*value};
}
inline void set(ExcavatorServo& servo, double ServoState::*value, const DriveVector& to) {
  for (unsigned i = 0; i < kDriveCount; ++i) {
    servo.drive[i].*value = to[i];
  }
}

inline DriveVector corrected_velocity(const ExcavatorProfile& profile, const DriveVector& wanted,
                                      const ExcavatorServo& servo, double lambda,
                                      double speed_override_ratio, bool hold = false) {
  return graben::corrected_velocity(excavator_bank(profile).rows(), wanted, servo, lambda,
                                    speed_override_ratio, hold);
}

inline VelocityCap stroke_end_cap(const ExcavatorProfile& profile, const DriveVector& travel_m,
                                  const DriveVector& velocity_mps) {
  std::array<ValidDrive, kDriveCount> seen;
  for (unsigned i = 0; i < kDriveCount; ++i) {
    seen[i].stroke_m = travel_m[i];
  }
  VelocityCap cap;
  slow_at_ends(excavator_bank(profile).rows(), seen, span_of(velocity_mps), cap);
  return cap;
}

}  // namespace graben::test
