// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Inputs and outputs of the excavator's controller. SI units; axes in the order boom,
/// arm, bucket, drives with the swing after them. Extension is positive for strokes, velocities,
/// spools and duties, and so is the swing to the left; a stroke counts from the closed cylinder.

#include <Eigen/Core>
#include <array>

#include "firmware/signals/machine_signals.hpp"

namespace graben {

/// Axes with a cylinder. [-; size: boom, arm, bucket]
inline constexpr int kAxisCount = 3;
/// Most drives of a machine; it may be without swing. [-; size: the axes and the swing]
inline constexpr int kDriveCount = 4;
/// Most pumps of a machine; it may have one. [-; size: the two of Kim's 22 t machine]
inline constexpr int kPumpCount = 2;

using AxisInputs = DriveInputs;

/// Of the swing motor. Each pressure is that of the port that turns the platform that way.
struct SwingInputs {
  Signal<double> angle_rad;
  Signal<double> left_pressure_pa;
  Signal<double> right_pressure_pa;
  Signal<double> spool_ratio;
};

/// Number of the IMU on the platform; those on links have their axis's. [-; derived: after the
/// axes]
inline constexpr int kBodyImu = kAxisCount;
/// Most IMUs of a machine. [-; size: one a link and one on the platform]
inline constexpr int kImuCount = kBodyImu + 1;

/// What a gyro shows, about the sensor's own axes: pitch lifts its front, roll is about its long
/// axis, yaw about its upright one; those two as of a right-handed turn.
struct ImuRates {
  double pitch_radps = 0.0;
  double roll_radps = 0.0;
  double yaw_radps = 0.0;
  double latency_s = -1.0;  ///< Age as it was sent; negative: not said.
};

/// What an accelerometer shows: specific force to the sensor's front and upwards.
struct ImuForces {
  double longitudinal_mps2 = 0.0;
  double vertical_mps2 = 0.0;
};

struct ImuInputs {
  Signal<ImuRates> rates;
  Signal<ImuForces> forces;
};

struct ExcavatorInputs : MachineInputs {
  std::array<AxisInputs, kAxisCount> axis;
  std::array<Signal<double>, kAxisCount> joint_rad;  ///< Where the bus has them and no strokes.
  std::array<ImuInputs, kImuCount> imu;              ///< Looked at only where the profile has IMUs.
  SwingInputs swing;  ///< Looked at only where the profile has a swing drive.
  /// By second sensors; looked at only where the profile has them.
  std::array<Signal<double>, kAxisCount> second_stroke_m;
  Signal<double> second_swing_rad;
  std::array<Signal<double>, kPumpCount> swash_ratio;  ///< tan(alpha) / tan(alpha at full swash).
  /// The operator's levers, -1 .. 1; one that the station does not have is 0.
  Signal<std::array<double, kDriveCount>> lever_ratio;
  Signal<std::array<double, kAxisCount>> tried_ratio;  ///< Duties of Task::kCommission, -1 .. 1.
  std::array<Signal<StrokeWindow>, kAxisCount> window;
};

/// Purpose of a task's step; the numbers are on the bus.
enum class StepKind : std::uint8_t {
  kNone = 0,
  kApproach = 1,  ///< From where the machine stands to where the task begins.
  kDig = 2,
  kLift = 3,
  kSwing = 4,
  kDump = 5,
  kReturnToDig = 6,
  kDone = 7,  ///< The task is at its end; the machine stands.
  kWait = 8,  ///< It stands until the operator asks for the task anew.
};

/// What ends a step.
enum class UntilKind : std::uint8_t {
  kEnd = 0,    ///< It has come to its planned end.
  kFull = 1,   ///< The bucket is full, by what the edge has passed.
  kForce = 2,  ///< The ground holds the teeth with a force.
  kPlane = 3,  ///< The teeth have come to a plane.
};

/// Progress of a task.
struct TaskProgress {
  bool runs = false;  ///< Without it the rest says nothing.
  std::uint8_t number = 0;
  std::uint8_t step = 0;
  StepKind kind = StepKind::kNone;
  double share = 0.0;  ///< Of the step, 0 .. 1.
  /// Steps that went on though they had not arrived, since the task began; 250: or more.
  std::uint8_t missed = 0;
  std::uint8_t round = 0;       ///< Of a program whose rounds lay their digs farther and farther,
  std::uint8_t next_round = 0;  ///< and that which this one leads to.
  UntilKind last_end = UntilKind::kEnd;  ///< What the step before this one was ended by.
  bool off_plan = false;                 ///< The step has begun elsewhere than the program has it.
};

/// Where a valve opens, on one side: learnt, as a share of the spool's travel from where the
/// profile says; positive opens later.
struct LearntEdge {
  bool known = false;
  double beyond_ratio = 0.0;
};

/// Of a cylinder's valve.
struct LearntEdges {
  LearntEdge extend;
  LearntEdge retract;
};

/// What the bucket is held by and what it carries, by chamber pressures, pose and motion; see
/// load_observer.hpp. A standard deviation is that of the error; of the force, of each component.
struct TipLoad {
  bool known = false;  ///< Of the force: pressures, pose and the links' masses are known.
  /// Of the ground on the teeth, in the plane of the links: x outwards, y up.
  Eigen::Vector2d force_n = Eigen::Vector2d::Zero();
  double force_sd_n = 0.0;
  bool payload_known = false;  ///< It was lifted free and lies in the bucket since, or it is empty.
  double payload_kg = 0.0;
  double payload_sd_kg = 0.0;
};

/// A joint by its sensors, with the standard deviation of the error.
struct JointAngle {
  double angle_rad = 0.0;
  double sd_rad = 0.0;
};

/// Joints by IMUs, or as they are measured; then nothing is said of the error.
struct JointAngles {
  bool known = false;  ///< Of all of them; without it the rest says nothing.
  std::array<JointAngle, kAxisCount> joint{};
  std::array<double, kAxisCount> stroke_m{};  ///< That they stand for.
};

/// What Task::kAssist does about its design; the numbers are on the bus.
enum class AssistState : std::uint8_t {
  kNone = 0,    ///< Another task, or there is no design.
  kAway = 1,    ///< The edge is farther from it than assist.window, or where it lies is not known.
  kNear = 2,    ///< It will be held once the arm's lever moves.
  kHolds = 3,   ///< Boom and bucket follow the arm.
  kLetGo = 4,   ///< The boom's lever was raised, or the swing's moved: the arm's has to rest first.
  kBeyond = 5,  ///< The edge is beyond the border of its design, of which nothing is known there.
};

/// Status of the excavator's controller.
struct ExcavatorStatus : MachineStatus {
  JointAngles joints;  ///< Of a machine with IMUs or measured joints; told in every mode.
  /// V_L^d before scaling by lambda; the swing's at its lever, see SwingProfile.
  std::array<double, kDriveCount> wanted_velocity_mps{};
  std::array<double, kPumpCount> pump_pressure_pa{};  ///< P_p that the solution expects.
  double path_error_m = 0.0;        ///< Distance of the measured tip from the path.
  double swing_wanted_radps = 0.0;  ///< Of a machine that swings.
  bool swings = false;
  TaskProgress progress;
  AssistState assist = AssistState::kNone;
  std::uint8_t site = 0;  ///< SiteKnown (fences/site_frame.hpp); told in every mode.
  std::array<LearntEdges, kAxisCount> edges{};
  TipLoad tip_load;  ///< Told in every mode.
};

struct ExcavatorOutputs : MachineOutputs {
  std::array<double, kDriveCount> duty_ratio{};  ///< -1 .. 1; 0 is neutral.
  std::array<double, kPumpCount> swash_ratio{};  ///< Wanted of each pump; only with enable.
  ExcavatorStatus status;
};

}  // namespace graben
