// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The dozer's controller: one step from signals to commands, 100 times a second.

#include "firmware/core/sealed.hpp"
#include "firmware/dozer/status/status.hpp"

namespace graben {

/// Dozer controller configuration, computed once, at start or before it goes into flash.
struct DozerSetup {
  // NOLINTNEXTLINE(google-explicit-constructor): a profile is all that it takes.
  DozerSetup(const DozerProfile& machine);

  DozerProfile profile;  ///< Must have passed the application's check.
  DozerBank bank;
  BladeKinematics blade;
  TiltKinematics tilt;
  GradeProfile design;
};

/// Belongs to the tests; nothing of ours defines it.
struct DozerMemoryAccess;

/// Holds what one cycle hands to the next, under a seal; what the machine is stays with the caller.
/// No clock, no globals, no heap; `step` costs a bounded number of operations.
class DozerController {
 public:
  /// `setup` has to outlive it and its copies.
  explicit DozerController(const DozerSetup& setup);
  explicit DozerController(DozerSetup&&) = delete;

  /// One cycle. Any fault gives neutral commands and its code; time only ever counts by
  /// difference, and `now_us` must not fall from call to call.
  [[nodiscard]] DozerOutputs step(const DozerInputs& inputs, TimeUs now_us);

 private:
  /// Lets tests flip a bit of what is stored.
  friend struct DozerMemoryAccess;

  /// Each stage's own, and what one cycle hands to the next.
  struct Memory {
    /// As before the first cycle.
    explicit Memory(const DozerSetup& setup) : estimates(setup.design, setup.profile.grade) {}

    CycleMemory cycle;
    DozerInputState inputs;
    DozerEstimates estimates;
    BladeMotionState motion;
    TravelLimitState limits;
    DozerOutputState output;
    DozerLastCycle last;
  };

  const DozerSetup& setup_;
  const DozerModel machine_;
  Sealed<Memory> memory_;
  Preview preview_;  ///< Made anew in each cycle.
};

}  // namespace graben
