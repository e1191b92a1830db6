// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A bank of drives around a cycle, for a kind that watches nothing else: what is kept, and the
/// steps before and after the kind's own motion.

#include "firmware/drives/drive_gate.hpp"
#include "firmware/drives/drive_servo.hpp"
#include "firmware/drives/drive_watch.hpp"
#include "firmware/drives/velocity_cap.hpp"
#include "firmware/safety/cycle.hpp"

namespace graben {

template <int kMost>
struct BankValid : CommonValid {
  std::array<ValidDrive, kMost> drive{};
};

/// What a kind wants of its drives in a cycle, before lambda.
template <int kMost>
struct BankMotion {
  std::array<double, kMost> wanted_mps{};     ///< V_L^d
  std::array<double, kMost> corrected_mps{};  ///< With the servos' corrections, slowed by `cap`.
  VelocityCap cap;
};

/// What one cycle hands to the next.
template <int kMost>
struct BankMemory {
  CycleMemory cycle;
  double lambda = 0.0;                  ///< Of the last cycle; 0 unless it was Active.
  std::array<double, kMost> opening{};  ///< x / x_m
  std::array<double, kMost> sent{};     ///< Duties that the gate let through.
  std::array<AcceptedStroke, kMost> accepted;
  DriveWatchState<kMost> watch;
  SlowingState slowing;
  LastCommands<kMost> last;
  std::array<LoadState, kMost> load{};
  std::array<ServoState, kMost> servo;
  std::array<double, kMost> expected_mps{};  ///< lambda V_L^d, without corrections.
};

/// Signals of the drives into `valid`, which has the common ones; faults sorted, drives watched,
/// the operator's speed times `degraded_ratio` while anything is degraded.
template <int kMost>
void read_and_watch(DriveRows drives, const BusCapabilities& bus, Span<const DriveInputs> inputs,
                    const Freshness& fresh, double degraded_ratio, double period_s,
                    BankMemory<kMost>& memory, BankValid<kMost>& valid) {
  const bool moving = memory.last.moving;
  read_drives(drives, inputs, moving, fresh, memory.accepted, valid.drive, valid.faults);
  sort_faults(moving, {{Fault::kStrokeJump, Fault::kStrokeMissing}}, valid);
  stop(watch_drives(drives, bus, memory.last, valid.drive, period_s, memory.watch, valid), valid);
  memory.slowing = slow_down(degraded_ratio, memory.slowing, moving, period_s, valid);
}

/// Loads and servos after the last cycle's command.
template <int kMost>
void estimate(DriveRows drives, const BankValid<kMost>& valid, const Cycle& cycle,
              double pressure_filter_s, BankMemory<kMost>& memory) {
  next_loads(pressure_filter_s, valid.drive, cycle.elapsed_s, cycle.last_mode != EcuMode::kActive,
             memory.load);
  for (int i = 0; i < drives.count(); ++i) {
    const auto k = static_cast<unsigned>(i);
    servo_after(drives[i], cycle.last_mode, memory.expected_mps[k], valid.drive[k].stroke_m,
                cycle.elapsed_s, memory.servo[k]);
  }
}

/// Corrections, the ends of the travel and the cap of both; at rest where nothing is wanted.
template <int kMost>
void correct(DriveRows drives, const BankValid<kMost>& valid, const BankMemory<kMost>& memory,
             BankMotion<kMost>& motion) {
  for (int i = 0; i < drives.count(); ++i) {
    const auto k = static_cast<unsigned>(i);
    motion.corrected_mps[k] = corrected_mps(drives[i], memory.servo[k], motion.wanted_mps[k],
                                            memory.lambda, valid.speed_override_ratio, false);
  }
  slow_at_ends(drives, valid.drive, motion.corrected_mps, motion.cap);
  for (double& each_mps : motion.corrected_mps) {
    each_mps *= motion.cap.factor;
  }
}

/// Opens the spools as far as the mode lets them, the gate last.
template <int kMost>
[[nodiscard]] GateResult put_out(DriveRows drives, bool active, Span<const double> spool_m,
                                 double period_s, BankMemory<kMost>& memory,
                                 Span<double> duty_ratio) {
  std::array<double, kMost> wanted_ratio{};
  if (active) {
    open_spools(drives, spool_m, period_s, memory.opening, wanted_ratio);
  }
  const GateResult gated =
      gate_duties(drives, active, wanted_ratio, period_s, memory.sent, duty_ratio);
  if (!gated.enable) {
    memory.opening = {};
  }
  return gated;
}

/// Keeps what the next cycle needs of this one; `lambda` is the valve's.
template <int kMost, class Outputs>
void remember(const ModeDecision& decision, const Outputs& outputs, const BankMotion<kMost>& motion,
              double lambda, BankMemory<kMost>& memory) {
  const double followed = decision.active() ? lambda : 0.0;
  memory.lambda = followed;
  memory.last = {in_motion(decision.mode.mode), outputs.enable, outputs.duty_ratio, {}};
  memory.last.active = decision.active();
  for (unsigned k = 0; k < kMost; ++k) {
    memory.last.asked_mps[k] = followed * motion.corrected_mps[k];
    memory.last.opening[k] = memory.opening[k];
    memory.expected_mps[k] = followed * motion.cap.factor * motion.wanted_mps[k];
  }
}

}  // namespace graben
