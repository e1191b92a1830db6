#pragma once
/// The excavator's controller: one step from signals to commands, 100 times a second.

#include "firmware/drives/cylinder_servo.hpp"
#include "firmware/drives/drive_gate.hpp"
#include "firmware/drives/load_filter.hpp"
#include "firmware/excavator/field/dig_field.hpp"
#include "firmware/excavator/safety/excavator_watch.hpp"
#include "firmware/excavator/tasks/task_follow.hpp"
#include "firmware/mcv/steady_lambda.hpp"
#include "firmware/safety/cycle_watch.hpp"
#include "firmware/safety/mode.hpp"
#include "firmware/safety/status.hpp"

namespace graben {

/// What an excavator's controller is made of: all that is worked out once, at start or, for an ECU
/// that keeps it in flash, before it is built.
struct ExcavatorSetup {
  // NOLINTNEXTLINE(google-explicit-constructor): a machine without programs is one too.
  ExcavatorSetup(const ExcavatorProfile& machine, const TaskBook& tasks = {});

  ExcavatorProfile profile;  ///< Must have passed its check (`profile_check`).
  TaskBook book;             ///< Planned for it (`plan_program`).
  SwingKinematics kinematics;
  DigField field;
  McvMachine valve;
};

/// Belongs to the tests; nothing of ours defines it.
struct ControllerMemoryAccess;

/// Holds what one cycle hands to the next; what the machine is stays with the caller.
/// No clock, no globals, no heap; `step` costs a bounded number of operations.
class ExcavatorController {
 public:
  /// `setup` has to outlive it and its copies.
  explicit ExcavatorController(const ExcavatorSetup& setup);
  explicit ExcavatorController(ExcavatorSetup&&) = delete;

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
    TaskMemory task;
    double swing_wanted_mps = 0.0;  ///< V_L^d of the last cycle's program.
    CycleState time;
    PilotState pilot;
  };

  /// What a cycle asks of the drives, whatever the task.
  struct Motion {
    DriveVector wanted_mps = DriveVector::Zero();     ///< V_L^d, the swing's at its lever.
    DriveVector corrected_mps = DriveVector::Zero();  ///< With what the drives owe.
    VelocityCap cap;
    double path_error_m = 0.0;
    TaskWant task;  ///< Of a program.
  };

  /// Whether what one cycle handed to the next is as it was.
  [[nodiscard]] Fault memory_fault() const;
  /// Inputs with all that validation and watches have to say of them.
  [[nodiscard]] WatchResult judge(const ExcavatorInputs& inputs, double period_s, TimeUs now_us);
  /// Takes in what this cycle's sensors say of the last cycle's command; `aim` is where the program
  /// that runs has come to.
  void observe(const ValidInputs& valid, const TaskAim& aim, double period_s);
  /// The program that is being followed and goes on to be asked for; null without one.
  [[nodiscard]] const TaskProgram* running(const ValidInputs& valid) const;
  [[nodiscard]] Motion dig_motion(const ValidInputs& valid, const KinematicState& state) const;
  [[nodiscard]] Motion task_motion(const TaskProgram& program, const TaskAim& aim,
                                   double speed_override_ratio, double period_s) const;
  void describe_motion(const Motion& motion, const McvSolution& solution, const FaultSet& degraded,
                       ExcavatorStatus& status) const;
  /// The program's place after this cycle.
  [[nodiscard]] TaskMemory task_afterwards(const ValidInputs& valid, const Motion& motion,
                                           EcuMode mode, double lambda, double period_s) const;
  /// What the field wants where the cylinders will be when a command of now takes effect.
  [[nodiscard]] DriveVector dig_velocity(const ValidInputs& valid,
                                         const KinematicState& state) const;

  const ExcavatorProfile& profile_;
  const SwingKinematics& kinematics_;
  const TaskBook& book_;
  const DigField& field_;
  const McvMachine& valve_;
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
