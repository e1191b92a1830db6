// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The excavator's controller: one step from signals to commands, 100 times a second.

#include "firmware/core/sealed.hpp"
#include "firmware/excavator/learnt_drives.hpp"
#include "firmware/excavator/status/status.hpp"

namespace graben {

/// Excavator controller configuration, computed once: at start or, for an ECU that keeps it in
/// flash, before it is built.
struct ExcavatorSetup {
  // NOLINTNEXTLINE(google-explicit-constructor): a machine without programs is one too.
  ExcavatorSetup(const ExcavatorProfile& machine, const TaskBook& tasks = {});

  ExcavatorProfile profile;  ///< Must have passed its check (`profile_check`).
  TaskBook book;             ///< Planned for it (`plan_program`).
  ExcavatorBank bank;
  SwingKinematics kinematics;
  DigField field;
  McvMachine valve;
  OilGains oil;  ///< All 0 unless control.law has the oil as a state.
};

/// Belongs to the tests; nothing of ours defines it.
struct ControllerMemoryAccess;

/// Holds what one cycle hands to the next, under a seal; what the machine is stays with the caller.
/// No clock, no globals, no heap; `step` costs a bounded number of operations.
class ExcavatorController {
 public:
  /// `setup` has to outlive it and its copies.
  explicit ExcavatorController(const ExcavatorSetup& setup);
  explicit ExcavatorController(ExcavatorSetup&&) = delete;

  /// One cycle. Any fault gives neutral commands and its code; time only ever counts by
  /// difference, and `now_us` must not fall from call to call.
  [[nodiscard]] ExcavatorOutputs step(const ExcavatorInputs& inputs, TimeUs now_us);

  /// What it has learnt of its valves so far.
  [[nodiscard]] LearntDrives learnt() const;
  /// To begin with what another run has learnt, before the first step. False, and nothing has
  /// changed, if that is not sound.
  [[nodiscard]] bool begin(const LearntDrives& learnt);

  /// The machine is not, or not surely, where its tasks' file has it: see is_left().
  [[nodiscard]] bool site_is_left() const;
  /// An earlier run with the same file has left it so: unknown until it is touched. To be called
  /// before the first step.
  void begin_left_site();

 private:
  /// Lets tests flip a bit of what is stored.
  friend struct ControllerMemoryAccess;

  /// Each stage's own, and what one cycle hands to the next.
  struct Memory {
    CycleMemory cycle;
    InputState inputs;
    EstimationState estimates;
    MotionMemory motion;
    LimitState limits;
    OutputState output;
    LastCycle last;
  };

  /// Stages two to four. Not inlined, for the stack below the solver.
  [[nodiscard, gnu::noinline]] Motion next_motion(const ExcavatorValid& valid, const Cycle& cycle);

  const ExcavatorModel machine_;
  const MotionSources sources_;
  Sealed<Memory> memory_;
};

/// Result of checking that a profile makes a controller: the valve's data are sound and the path
/// can be reached.
struct ProfileCheck {
  McvCheck valve;
  ReachStatus path = ReachStatus::kOk;
  TipPose unreached;  ///< Where the path leaves the work space.
};
[[nodiscard]] ProfileCheck profile_check(const ExcavatorProfile& profile);

}  // namespace graben
