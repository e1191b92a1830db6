// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The excavator's controller: one step from signals to commands, 100 times a second.

#include "firmware/drives/commission_guard.hpp"
#include "firmware/drives/drive_gate.hpp"
#include "firmware/drives/spool_lead.hpp"
#include "firmware/drives/spool_parking.hpp"
#include "firmware/drives/velocity_cap.hpp"
#include "firmware/estimation/foretold_angle.hpp"
#include "firmware/excavator/excavator_drives.hpp"
#include "firmware/excavator/motion/field/dig_field.hpp"
#include "firmware/excavator/inputs/imu_joints.hpp"
#include "firmware/excavator/estimation/load/load_observer.hpp"
#include "firmware/excavator/estimation/oil/held_load.hpp"
#include "firmware/excavator/outputs/pump_demand.hpp"
#include "firmware/excavator/inputs/excavator_validation.hpp"
#include "firmware/excavator/swing.hpp"
#include "firmware/excavator/motion/hand/hand_motion.hpp"
#include "firmware/excavator/limits/motion_cap.hpp"
#include "firmware/excavator/motion/program/task_follow.hpp"
#include "firmware/mcv/optimiser.hpp"
#include "firmware/safety/cycle.hpp"
#include "firmware/safety/stall_watch.hpp"
#include "firmware/safety/task_change.hpp"
#include "firmware/safety/tube.hpp"

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

  /// Motion that a cycle asks of the drives, whatever the task.
  struct Motion {
    DriveVector wanted_mps = DriveVector::Zero();     ///< V_L^d, the swing's at its lever.
    DriveVector corrected_mps = DriveVector::Zero();  ///< With the servos' corrections.
    DriveVector towards_mps = DriveVector::Zero();    ///< The same, not eased (blocked.hpp).
    VelocityCap cap;
    double path_error_m = 0.0;
    double off_m = 0.0;  ///< What the tube is laid around.
    TaskWant task;       ///< Of a program.
    HandWant hand;       ///< By the levers.
    Fault fault = Fault::kNone;
    bool eases = false;  ///< A blocked drive's pressure is let off or rests; all others stand.
    bool tries = false;  ///< Task::kCommission: no motion is wanted, the duties are given.
  };

  /// What the pumps' flow leaves of a motion. The path alone decides how fast it is followed, with
  /// the reserve: corrections change sign from cycle to cycle. What they then ask for beyond the
  /// flow slows both.
  struct Followed {
    McvSolution solution;       ///< Of the motion with its corrections.
    double lambda = 0.0;        ///< Of the motion without them.
    double of_corrected = 0.0;  ///< Share of that, with them.

    bool as_wanted = false;  ///< Without corrections: they would have held up a move.
    bool eases = false;      ///< Of the motion; then the path has no share in it.

    /// Of the corrected motion.
    [[nodiscard]] double all() const { return (eases ? 1.0 : lambda) * of_corrected; }
    /// Of the path.
    [[nodiscard]] double of_way() const { return eases ? 0.0 : lambda * of_corrected; }
  };

  struct Memory {
    CycleMemory cycle;
    Guarded<double> lambda;  ///< Of the last cycle in motion, without corrections.
    std::array<Guarded<double>, kDriveCount> opening;
    std::array<AcceptedStroke, kDriveCount> accepted;
    ImuState imus;
    std::array<ForetoldAngle, kAxisCount> foretold;  ///< Of measured joints that come late.
    JointAngles joints;
    ExcavatorWatchState watch;
    LastCommands<kDriveCount> last;
    std::array<LoadState, kDriveCount> load{};
    ExcavatorServo servo;
    OilState oil;
    OilModes modes;
    HeldLoad held;
    double payload_kg = 0.0;  ///< As weighed at rest.
    LoadObserver load_observer;
    TipLoad tip_load;
    std::array<SpoolModel, kDriveCount> spool;
    std::array<ParkingState, 2> parking;  ///< Of boom and arm.
    HandState hand;
    bool jogs = false;  ///< Last: drives that are not told to move are nobody's.
    std::array<CommissionState, kDriveCount> commission;
    std::array<double, kDriveCount> tried_ratio{};  ///< Duties of this cycle that may be sent.
    PumpDemand pumps;
    double of_corrected = 1.0;  ///< Of the last cycle, see Followed.
    PerPump<double> line_pa{};  ///< Of the last cycle's solution.
    /// lambda V_L^d, without corrections: what the servo expects of the drives.
    DriveVector expected_mps = DriveVector::Zero();
    TaskMemory task;
    TaskChangeState change;
    StallState stall;
    TubeState tube;
    SwingPush swing_push;
    double swing_wanted_mps = 0.0;  ///< V_L^d of the last cycle's program.
  };

  /// What the valve is asked for; where no pressures are measured, at the worst loads.
  [[nodiscard]] McvInput input_for(const DriveVector& wanted_mps,
                                   const ExcavatorValid& valid) const;
  [[nodiscard]] DriveRows drives() const { return setup_.bank.rows(); }
  [[nodiscard]] bool intact() const { return memory_.lambda.intact() && memory_.task.intact(); }
  /// Inputs that may be used, the strokes by IMUs.
  [[nodiscard]] ExcavatorValid read_by_imus(const ExcavatorInputs& inputs, const Cycle& cycle,
                                            TimeUs now_us);
  /// The same, the strokes by measured joints.
  [[nodiscard]] ExcavatorValid read_by_angles(const ExcavatorInputs& inputs, TimeUs now_us);
  [[nodiscard]] ExcavatorValid validate_and_watch(const ExcavatorInputs& inputs, const Cycle& cycle,
                                                  TimeUs now_us);
  /// Guards duties that are tried, and gives those that may be sent with what holds them back.
  void guard_commission(const Cycle& cycle, ExcavatorValid& valid);
  [[nodiscard]] Limit commission_limit() const;
  /// The last gate before the bus.
  [[nodiscard]] GateResult gate(const Motion& motion, bool active, const McvPoint& point,
                                double period_s, ExcavatorOutputs& outputs);
  /// Loads and servos after the last cycle's command; `aim` is where the program that runs has come
  /// to.
  /// What is wanted, with its corrections. Not inlined: aim and pose would lie on the stack below
  /// the solver, which is the deepest there is.
  [[nodiscard, gnu::noinline]] Motion next_motion(const ExcavatorValid& valid, const Cycle& cycle);
  void estimate(const ExcavatorValid& valid, const TaskAim& aim, const Cycle& cycle);
  /// The program that is being followed and goes on to be asked for; null without one.
  [[nodiscard]] const TaskProgram* running(const ExcavatorValid& valid) const;
  [[nodiscard]] Motion wanted_motion(const ExcavatorValid& valid, const KinematicState& now,
                                     const TaskProgram* program, const TaskAim& aim,
                                     double period_s) const;
  /// What the field wants of each cylinder at the place where its command of now takes effect.
  [[nodiscard]] DriveVector by_field(const KinematicState& now, double speed_override_ratio) const;
  void dig(const ExcavatorValid& valid, const KinematicState& now, Motion& motion) const;
  /// Boom and arm, `off_m` beyond where they should be, corrected by the oil's state instead of the
  /// servo, as far as it leads.
  void correct_on_oil(double speed_override_ratio, const Eigen::Vector2d& off_m,
                      Motion& motion) const;
  /// Off the dig's path.
  void correct_off_path(const ExcavatorValid& valid, const KinematicState& now,
                        Motion& motion) const;
  /// Off a cut's plan: what is on its way is part of where they are.
  void correct_off_plan(double speed_override_ratio, Motion& motion) const;
  /// What the oil's law may lead: a dig's path and cuts.
  [[nodiscard]] bool leads_on_oil(const ExcavatorValid& valid) const;
  /// Observer of the oil after the last cycle's command.
  void weigh(const OilSeen& seen, const KinematicState& now, EcuMode mode);
  void estimate_oil(const ExcavatorValid& valid, const KinematicState& now, EcuMode mode);
  /// Tip force and payload, of `memory_.tip_load`.
  void estimate_load(const ExcavatorValid& valid, const TaskAim& aim, const KinematicState& now,
                     const Cycle& cycle);
  /// Boom and arm stand where their corrections would reverse them for little.
  void park_spools(const ExcavatorValid& valid, double period_s, Motion& motion);
  /// Duties for the valves as they turned out to be.
  void open_as_learnt(ExcavatorOutputs& outputs) const;
  void tell_learnt(ExcavatorStatus& status) const;
  /// Duties that lead through the spools' lag. The watches know of those without: that is where
  /// the spools are to be.
  void lead_spools(ExcavatorOutputs& outputs);
  [[nodiscard]] static HandAsk hand_ask(const ExcavatorValid& valid);
  /// By the levers.
  void steer(const ExcavatorValid& valid, const KinematicState& now, double period_s,
             Motion& motion) const;
  void follow(const TaskProgram& program, const TaskAim& aim, double speed_override_ratio,
              double period_s, Motion& motion) const;
  /// Slows before ends and fences; beyond a fence only what leads back moves.
  void hold_at_fences(const FenceSet& fences, double zero_m, Motion& motion) const;
  /// Asks no more of a drive that its load holds than path or plan want.
  void ease_blocked(Motion& motion) const;
  [[nodiscard]] Followed flow_limited(const ExcavatorValid& valid, const Motion& motion,
                                      double period_s) const;
  /// Swash for what is wanted in this cycle.
  void demand_pumps(const ExcavatorValid& valid, const Motion& motion, bool active,
                    double period_s);
  void describe_motion(const Motion& motion, const Followed& taken, const FaultSet& degraded,
                       ExcavatorStatus& status) const;
  /// Not inlined, for the stack below it.
  [[gnu::noinline]] void stop_task() { memory_.task = stopped(memory_.task); }
  /// Keeps what the next cycle needs of this one.
  void remember(const ExcavatorValid& valid, const Motion& motion, const Followed& taken,
                const ModeDecision& decision, const ExcavatorOutputs& outputs, double period_s);

  const ExcavatorSetup& setup_;
  const ExcavatorProfile& profile_;
  Memory memory_;
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
