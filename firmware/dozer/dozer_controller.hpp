#pragma once
/// The dozer's controller: one step from signals to commands, 100 times a second.

#include "firmware/dozer/blade_control.hpp"
#include "firmware/dozer/safety/brake.hpp"
#include "firmware/dozer/safety/dozer_gate.hpp"
#include "firmware/dozer/safety/dozer_watch.hpp"
#include "firmware/dozer/travel/position_filter.hpp"
#include "firmware/dozer/travel/speed_limit.hpp"
#include "firmware/dozer/travel/track_control.hpp"
#include "firmware/safety/cycle_watch.hpp"
#include "firmware/safety/status.hpp"

namespace graben {

/// What a dozer's controller is made of, as ExcavatorSetup.
struct DozerSetup {
  // NOLINTNEXTLINE(google-explicit-constructor): a profile is all that it takes.
  DozerSetup(const DozerProfile& machine);

  DozerProfile profile;  ///< Must have passed the application's check.
  BladeKinematics blade;
  GradeProfile design;
};

/// Belongs to the tests; nothing of ours defines it.
struct DozerMemoryAccess;

/// Holds what one cycle hands to the next; what the machine is stays with the caller.
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

  struct Memory {
    Guarded<ModeState> mode;
    DozerGateState gate;
    Guarded<double> speed_mps;  ///< v_c of the last cycle in motion.
    DozerValidationState validation;
    DozerWatchState watch;
    DozerLastCycle cycle;
    SpeedState speed;
    BladeState blade;
    std::array<TrackState, kTrackCount> track{};
    PositionState position;
    CycleState time;
    PilotState pilot;
    BrakeState brake;
  };

  /// What a cycle wants to do before the gate.
  struct Wanted {
    BladeCommand blade;
    SpeedChoice speed;
    DozerCommand command;
    double required_flow_m3ps = 0.0;
    double available_flow_m3ps = 0.0;
  };

  /// Whether what one cycle handed to the next is as it was.
  [[nodiscard]] Fault memory_fault() const;
  /// Inputs with all that validation and watches have to say of them.
  [[nodiscard]] ValidDozerInputs judge(const DozerInputs& inputs, double period_s, TimeUs now_us);
  /// Takes in where the machine is: what the blade has cut, what lies ahead.
  void observe(const ValidDozerInputs& valid, double period_s);
  /// v_c of this cycle and what it is chosen from.
  [[nodiscard]] SpeedChoice choose_speed(const ValidDozerInputs& valid, const Wanted& wanted,
                                         double period_s) const;
  /// Blade, speed, displacements; what they hand on is kept only in motion.
  [[nodiscard]] Wanted want(const ValidDozerInputs& valid, double period_s);
  void keep(const Wanted& wanted, bool active);

  const DozerProfile& profile_;
  const BladeKinematics& blade_;
  const GradeProfile& design_;
  GroundMap ground_;
  Preview preview_;
  Memory memory_;
};

}  // namespace graben
