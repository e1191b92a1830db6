#pragma once
/// The excavator's controller: one step from signals to commands, 100 times a second.

#include "firmware/kinematics/excavator_kinematics.hpp"
#include "firmware/mcv/steady_lambda.hpp"
#include "firmware/motion/cylinder_servo.hpp"
#include "firmware/motion/dig_field.hpp"
#include "firmware/motion/load_filter.hpp"
#include "firmware/safety/cycle_watch.hpp"
#include "firmware/safety/gate.hpp"
#include "firmware/safety/mode.hpp"
#include "firmware/safety/standing.hpp"
#include "firmware/safety/watch.hpp"

namespace graben {

/// Belongs to the tests; nothing of ours defines it.
struct ControllerMemoryAccess;

/// Holds what the machine is (constant after construction) and what one cycle hands to the next.
/// No clock, no globals, no heap; `step` costs a bounded number of operations.
class ExcavatorController {
 public:
  /// The profile must have passed its check (`profile_check`).
  explicit ExcavatorController(const ExcavatorProfile& profile);

  /// One cycle. Any fault gives neutral commands and its code; time only ever counts by
  /// difference, and `now_us` must not fall from call to call.
  [[nodiscard]] ExcavatorOutputs step(const ExcavatorInputs& inputs, TimeUs now_us);

 private:
  /// Lets tests flip a bit of what is stored.
  friend struct ControllerMemoryAccess;

  struct Memory {
    Guarded<ModeState> mode;
    GateState gate;
    Guarded<double> lambda;  ///< Of the last cycle in motion.
    ValidationState validation;
    WatchState watch;
    LastCycle cycle;
    LoadState load;
    ServoState servo;
    /// lambda V_L^d, without corrections: what the servo expects of the drives.
    DriveVector expected_mps = DriveVector::Zero();
    CycleState time;
    PilotState pilot;
  };

  /// Whether what one cycle handed to the next is as it was.
  [[nodiscard]] Fault memory_fault() const;
  /// Inputs with all that validation and watches have to say of them.
  [[nodiscard]] WatchResult judge(const ExcavatorInputs& inputs, double period_s, TimeUs now_us);
  /// Takes in what this cycle's sensors say of the last cycle's command.
  void observe(const ValidInputs& valid, double period_s);
  /// V_L^d of the task that is chosen, the swing's at its lever.
  [[nodiscard]] DriveVector wanted_velocity(const ValidInputs& valid,
                                            const KinematicState& state) const;
  /// What the field wants where the cylinders will be when a command of now takes effect.
  [[nodiscard]] DriveVector dig_velocity(const ValidInputs& valid,
                                         const KinematicState& state) const;

  ExcavatorProfile profile_;
  ExcavatorKinematics kinematics_;
  DigField field_;
  McvMachine valve_;
  Memory memory_;
};

/// Whether a profile makes a controller: the valve's data are sound and the path can be reached.
struct ProfileCheck {
  McvCheck valve;
  ReachStatus path = ReachStatus::kOk;
  TipPose unreached;  ///< Where the path leaves the work space.
};
[[nodiscard]] ProfileCheck profile_check(const ExcavatorProfile& profile);

}  // namespace graben
