#pragma once
/// The machine against what it was told: all watches, and what they take away.

#include "firmware/drives/motion_watch.hpp"
#include "firmware/drives/pressure_watch.hpp"
#include "firmware/drives/spool_watch.hpp"
#include "firmware/excavator/safety/swash_watch.hpp"
#include "firmware/safety/degrade.hpp"

namespace graben {

struct WatchState {
  SpoolWatchState spool;
  MotionWatchState motion;
  PressureWatchState pressure;
  SwashWatchState swash{};
  SlowingState slowing;
  bool closing = false;  ///< It was in motion, and some spool has not been in its middle since.
};

/// What the last cycle did.
struct LastCycle {
  bool moving = false;  ///< Armed or Active.
  SentCommand sent;
  /// What the spools were opened for: lambda times the wanted velocity with its corrections. A
  /// stroke that stands still makes its cylinder owe, and that alone can run it to its end.
  DriveVector asked_mps = DriveVector::Zero();
};

struct WatchResult {
  /// As they came, with the watches' faults, `load_known` where no pressure is wrong, and the
  /// operator's speed times `safety.degraded_speed` while anything is degraded.
  ValidInputs inputs;
  std::array<double, kPumpCount> pump_flow_m3ps{};  ///< v omega tan(alpha) of (25).
};

/// `state` goes on by a cycle. Outside motion the machine may be moved by hand: spools, cylinders
/// and pressures are then not judged, and every watch begins afresh. Only spools are, until all
/// have been in their middle once or the operator has taken over in manual mode: one that stays
/// open when the deadman is let go is stuck. What degrades goes on doing so for 0.5 s.
[[nodiscard]] WatchResult watch(const ExcavatorProfile& profile, WatchState& state,
                                const LastCycle& cycle, const ValidInputs& inputs, double period_s);

}  // namespace graben
