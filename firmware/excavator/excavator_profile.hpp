// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Profile of an excavator, as its controller knows it: geometry, valve, pumps, task. Constant
/// after start; read and range-checked by the application, cross-checked by `profile_check`. SI
/// units. Sagittal plane: x forward, y up, origin at the boom foot pin; link frames have x from one
/// pin to the next; joint angles: boom against the horizontal, arm against the boom, bucket against
/// the arm, folding in is negative.

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "firmware/core/codes.hpp"
#include "firmware/excavator/excavator_signals.hpp"
#include "firmware/machine/mark.hpp"
#include "firmware/machine/spool_answer.hpp"
#include "firmware/machine/unknown_drives.hpp"
#include "firmware/machine/valve.hpp"
#include "firmware/signals/bus_capabilities.hpp"

namespace graben {

/// Number of the boom among the drives. [-; standard: LimitIndex of EcuStatus counts them so]
inline constexpr int kBoom = 0;
/// Number of the arm. [-; standard: as kBoom]
inline constexpr int kArm = 1;
/// Number of the bucket. [-; standard: as kBoom]
inline constexpr int kBucket = 2;
/// Number of the swing, theta_0 of Zhang et al., after the axes with a cylinder. [-; standard: as
/// kBoom]
inline constexpr int kSwing = 3;

/// One value a drive, in the order kBoom, kArm, kBucket, kSwing.
using DriveVector = Eigen::Vector4d;

/// Parallel cylinders of one axis. `base` is the pin on the link nearer to the body, `eye` the pin
/// on the rod's side; which frame each is in stands at the axis.
struct CylinderGeometry {
  int count = 1;
  double bore_m = 0.0;
  double rod_m = 0.0;
  double closed_length_m = 0.0;  ///< Pin to pin, closed.
  double stroke_m = 0.0;
  Eigen::Vector2d base_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d eye_m = Eigen::Vector2d::Zero();

  /// A_A: cap-side piston area of all of them together, m^2.
  [[nodiscard]] double cap_area_m2() const { return graben::cap_area_m2(count, bore_m); }
  /// A_B: rod-side piston area of all of them together, m^2.
  [[nodiscard]] double rod_area_m2() const { return graben::rod_area_m2(count, bore_m, rod_m); }
};

/// Rocker on the arm, coupler to the bucket's lug; the bucket cylinder pushes the rocker's end.
struct BucketLinkage {
  Eigen::Vector2d rocker_pivot_m = Eigen::Vector2d::Zero();  ///< Arm frame.
  double rocker_m = 0.0;
  double coupler_m = 0.0;
  Eigen::Vector2d lug_m = Eigen::Vector2d::Zero();  ///< Bucket frame, x from pin to tip.
};

/// A level bar across the machine's rear, its ends rounded, as high as it is.
struct Counterweight {
  double radius_m = 0.0;      ///< Swing axis to its farthest point; 0: none is known.
  double half_width_m = 0.0;  ///< To either side of the machine's plane.
  double corner_m = 0.0;      ///< Radius of its corners, seen from above.
  double low_m = 0.0;         ///< From here over the ground
  double high_m = 0.0;        ///< to here.

  [[nodiscard]] bool known() const { return radius_m > 0.0; }
};

/// All 0: teeth and pins are all that is known, as points.
struct ExcavatorBody {
  double bucket_width_m = 0.0;
  double floor_m = 0.0;        ///< Of the bucket, edge to heel.
  double floor_rad = 0.0;      ///< From the line edge to bucket pin down to the floor.
  double capacity_m3 = 0.0;    ///< Of loose soil, heaped.
  double boom_radius_m = 0.0;  ///< Round its pins' line and the bend, cylinders and hoses in it.
  double arm_radius_m = 0.0;   ///< Round its pins' line.
  Eigen::Vector2d boom_bend_m = Eigen::Vector2d::Zero();  ///< Boom frame; at its foot: straight.
  Counterweight counterweight;

  [[nodiscard]] bool known() const { return bucket_width_m > 0.0; }
};

struct ExcavatorGeometry {
  double boom_length_m = 0.0;
  double arm_length_m = 0.0;
  double bucket_length_m = 0.0;  ///< Pin to tip.
  /// Boom: base in the body frame, eye in the boom frame. Arm: base in the boom frame, eye in the
  /// arm frame. Bucket: base in the arm frame; its eye is the rocker's end.
  std::array<CylinderGeometry, kAxisCount> cylinder;
  BucketLinkage linkage;
  /// Boom foot pin: a_1 forward of the swing axis and d_0 above the ground, (2) of Zhang et al.
  Eigen::Vector2d boom_foot_m = Eigen::Vector2d::Zero();
  ExcavatorBody body;
};

/// The main control valve; metering is the same of every section.
struct ValveProfile : SpoolMetering {
  double section_flow_m3ps = 0.0;  ///< Rated, of one spool's section.
  std::array<SpoolProfile, kDriveCount> spool;
  DutyTable spool_to_duty;  ///< See SpoolAnswer; of every side that does not say its own.
  /// What is known of each side of each drive; the rest is the whole valve's, see `answer_of`.
  std::array<SaidAnswers, kDriveCount> answer;
};

/// Closed rounded rectangle that the bucket tip follows in the digging direction: down at the far
/// side, in along the bottom, up at the near side, out along the top.
struct DigPath {
  double x_min_m = 0.0;
  double x_max_m = 0.0;
  double y_min_m = 0.0;
  double y_max_m = 0.0;
  double corner_radius_m = 0.0;
  double attitude_at_x_min_rad = 0.0;  ///< Bucket attitude, linear in x between the two.
  double attitude_at_x_max_rad = 0.0;
};

/// One link as a rigid body, for how it swings on its oil.
struct LinkMass {
  double mass_kg = 0.0;
  double inertia_kgm2 = 0.0;                           ///< About the mass centre, out of plane.
  Eigen::Vector2d centre_m = Eigen::Vector2d::Zero();  ///< Link frame.
};

/// Oil columns and what they carry, as the controller takes them. All of it may be off: too soft
/// and too heavy does less harm than too stiff and too light.
struct OilProfile {
  double bulk_modulus_pa = 0.0;                     ///< 0: nothing is known of the oil.
  std::array<double, kAxisCount> dead_volume_m3{};  ///< Each of an axis' two chambers, with hose.
  std::array<LinkMass, kAxisCount> link;
  double spool_time_constant_s = 0.0;  ///< 1 / natural frequency of a spool.

  [[nodiscard]] bool known() const { return bulk_modulus_pa > 0.0; }
};

/// What each sensor shows where the truth is 0; taken off before anything else is made of it.
struct SensorZeros {
  std::array<double, kAxisCount> stroke_m{};
  std::array<double, kAxisCount> cap_pa{};
  std::array<double, kAxisCount> rod_pa{};
};

/// An IMU's place. Its own axes are those of its data sheet: long, upright, and lateral, about
/// which it pitches; the lateral one is to lie across the machine.
struct ImuMount {
  std::uint8_t address = 0;  ///< J1939 source address of its frames; 0: there is none.
  /// In the frame of its link, from the link's pin; a rocker's counts from the rocker's pivot, x to
  /// its end.
  Eigen::Vector2d at_m = Eigen::Vector2d::Zero();
  double turn_rad = 0.0;   ///< Its long axis against x of that frame; after it is turned about.
  bool backwards = false;  ///< Its front looks back: its long axis is turned about.
  bool on_rocker = false;  ///< Instead of the bucket, whose angle its linkage then gives.
};

/// IMUs on the links in the place of stroke sensors; noise and errors as the controller takes them,
/// each a standard deviation.
struct ImuProfile {
  std::array<ImuMount, kImuCount> mount;  ///< Boom, arm, bucket, and the platform if it may tilt.
  double rate_noise_radps = 0.0;          ///< Of one reading, vibration with it.
  double rate_bias_radps = 0.0;           ///< Before it is learnt.
  double force_noise_mps2 = 0.0;          ///< Of one reading, vibration with it.
  double angle_error_rad = 0.0;           ///< Constant, of each: alignment and accelerometer.
  double latency_s = 0.0;                 ///< Of one that does not say its own.

  [[nodiscard]] bool known() const { return mount[0].address != 0; }
  [[nodiscard]] bool has_body() const { return mount[kBodyImu].address != 0; }
};

/// Second sensors of joints, which are compared with the first ones and lead nothing.
struct SecondSensors {
  std::array<bool, kDriveCount> has{};
  double offset_m = 0.0;          ///< So far two strokes of a cylinder may differ, anywhere,
  double swing_offset_rad = 0.0;  ///< and two angles of the swing;
  double play_m = 0.0;            ///< so far that may change in motion;
  double swing_play_rad = 0.0;
  double scale = 0.0;         ///< so much more for each metre or radian that is shown.
  double least_age_s = 0.0;   ///< A second's reading is that much older than a first's at least
  double most_age_s = 0.0;    ///< and at most.
  bool arms_without = false;  ///< Where one of them is missing: slow.

  [[nodiscard]] bool strokes() const { return has[kBoom] || has[kArm] || has[kBucket]; }
  [[nodiscard]] bool any() const { return strokes() || has[kSwing]; }
};

/// Feedback around the valve's model; the numbers have no meaning outside.
enum class ControlLaw : std::uint8_t {
  kServo = 0,  ///< Integrated error of each drive, see drive_servo.hpp.
  kOil = 1,    ///< The oil as a state, see oil_law.hpp; the servo where it can't lead.
  kKim = 2,    ///< None: the field alone leads back to the path.
};

/// Convergence of the field, changes of commands, feedback. Ranges are checked where it is read.
struct ControlProfile {
  ControlLaw law = ControlLaw::kServo;
  double convergence_length_m = 0.0;  ///< Distance at which the field points at 45 deg to the path.
  double attitude_gain_ps = 0.0;      ///< Attitude error to attitude rate.
  double attitude_rate_max_radps = 0.0;  ///< Of the field.
  double approach_inner_m = 0.0;    ///< Stroke distance under which the contour field alone holds.
  double approach_outer_m = 0.0;    ///< Stroke distance over which the approach alone holds.
  double approach_speed_mps = 0.0;  ///< Largest cylinder speed of the approach.
  double stroke_end_gain_ps = 0.0;  ///< Largest speed towards a cylinder's end, per metre left.
  McvPolicy lambda_policy = McvPolicy::kGlobal;
  LambdaRise lambda_rise;
  double spool_rate_ps = 0.0;          ///< Largest change of |x| / x_m per second.
  double duty_rate_ps = kDutyRate_ps;  ///< Largest rise of a duty on the wire per second.
  double spool_threshold = 0.0;        ///< |x| / x_m under which a spool is kept at neutral.
  double sensor_timeout_s = 0.0;       ///< A signal older than this is missing.
  double response_s = 0.0;             ///< Lag of a cylinder's speed behind its spool command.
  double servo_gain_ps = 0.0;          ///< Integrated error of a cylinder's travel to speed.
  double swing_servo_most_rad = 0.0;   ///< Bound of its error where a plan turns it.
  double swing_lead_s = 0.0;  ///< Lag of the platform behind its spool, where a plan turns it.
  double swing_servo_gain_ps = 0.0;  ///< The same of the swing; the platform's oil is softer.
  double servo_most_m = 0.0;         ///< Bound of that error.
  double servo_least_lambda = 1.0;   ///< Corrections stay whole down to this lambda.
  double servo_frequency_hz = 0.0;   ///< Of the correction's low-pass; undamped.
  double servo_damping = 0.0;        ///< Its damping ratio.
  double pressure_filter_s = 0.0;    ///< Low-pass of the load that the valve's model compensates.
  double slow_error_m = 0.0;         ///< Path error at which the speed along the path is halved.
  double dead_time_s = 0.0;          ///< From a duty to the spool's first movement.
  /// Valves, the oil's stiffness and lasting lags are learnt at work; else all is as told.
  bool learns = true;
  double learn_share = 1.0;  ///< Of the pace for a machine as found, at which valves are learnt.
};

/// Bounds that the watches hold the machine to. Ranges are checked where it is read.
struct SafetyProfile {
  double degraded_speed_ratio = 0.0;  ///< Of the task's speed, while a sensor is lost.
  double idle_radps = 0.0;            ///< Engine at its slowest, assumed where its speed is lost.
  double settle_s = 0.0;              ///< Of the slowest sound spool, see drive_bank.hpp.
  double spool_tolerance = 0.0;       ///< Of the spool's travel.
  double uncommanded_m = 0.0;         ///< A cylinder may go so far where its spool does not lead.
  double sink_mps = 0.0;              ///< No faster does a drive sink whose spool is in its middle.
  double stuck_m = 0.0;               ///< Asked of a cylinder whose stroke stands still.
  double tube_m = 0.0;                ///< See leaves_tube(); of the teeth about path and plan.
  double stall_s = 0.0;               ///< So long it may hardly get on, see stall_watch.hpp.
  double swing_uncommanded_rad = 0.0;  ///< As uncommanded_m, of the swing.
  double swing_stuck_rad = 0.0;        ///< As stuck_m, of the swing.
  double swash_tolerance = 0.0;        ///< Of full swash.
  double pressure_rail_pa = 0.0;       ///< Where the pressure sensors end.
  /// Levers off their middle change on the bus at least so often, see lever_watch.hpp; 0: they need
  /// not.
  double levers_alive_s = 0.0;
  UnknownDrives unknown;  ///< See tell_unknown().
};

/// The platform's turning about the vertical, to the left and to the right. Where a motor on one of
/// the valve's sections drives it, it stands in the valve's equations as a cylinder with equal
/// areas: travel, speed, force and area are those at `lever_m` from the swing axis.
struct SwingProfile {
  double speed_max_radps = 0.0;
  double acceleration_max_radps2 = 0.0;
  double displacement_m3prad = 0.0;  ///< Of the motor with its reduction, per radian of swing.
  /// Of all that turns, links half out, about the swing axis; 0: not known, and its oil is not
  /// damped.
  double inertia_kgm2 = 0.0;
  double lever_m = 0.0;        ///< Chosen, so that its area is like a cylinder's.
  double right_end_rad = 0.0;  ///< Ends of the range that the controller keeps to.
  double left_end_rad = 0.0;

  [[nodiscard]] double area_m2() const { return displacement_m3prad / lever_m; }
};

/// Planning of straight lines of the teeth.
struct LineProfile {
  double acceleration_mps2 = 0.0;  ///< Of the teeth, unless the task says another.
  std::array<double, kAxisCount> cylinder_acceleration_mps2{};
  /// Of a task that is followed: error of the teeth at which the plan goes on at half its speed, on
  /// a straight line and on a move of the drives, which only has to arrive.
  double slow_error_m = 0.0;
  double slow_error_s = 0.0;  ///< So much more of it for each m/s of a line's planned speed.
  double move_slow_error_m = 0.0;
  double pace_rate_ps = 0.0;  ///< How fast it may slow down and speed up for that, per second.
  /// Rate at which a drive's lasting lag is learnt and given on top, per second of its error and
  /// second: leakage of the swing's motor, deadbands.
  double trim_ps2 = 0.0;
  double trim_most_mps = 0.0;  ///< No more than this.
};

/// What fences allow for, see fence_margin.hpp. All 0: the machine is where it is measured.
struct FenceProfile {
  double stroke_error_m = 0.0;   ///< Of a stroke as it is measured, at most.
  double swing_error_rad = 0.0;  ///< The same of the swing, and what it swings about its place.
  double give_m = 0.0;           ///< So far a point goes on where its drives are to stop.
  double room_m = 0.0;           ///< So much more is left to a planned way, beside
  double room_s = 0.0;           ///< this for each m/s of a point's planned speed.
};

/// Task::kAssist.
struct AssistProfile {
  double window_m = 0.0;  ///< The edge is held from this distance to the design on.
  double offset_m = 0.0;  ///< It is held so high over the design.
};

/// Between these a pump's swash goes by what the motion needs.
struct SwashRange {
  double least_ratio = 0.0;
  double most_ratio = 0.0;    ///< 0: it stays where it is.
  double most_power_w = 0.0;  ///< Pressure times flow of all pumps: what the engine can give them.
};

struct ExcavatorProfile {
  BusCapabilities bus;
  int drive_count = kAxisCount;  ///< kDriveCount with a swing section of the valve.
  ExcavatorGeometry geometry;
  SwingProfile swing;
  LineProfile line;
  FenceProfile fence;
  AssistProfile assist;
  ValveProfile valve;
  int pump_count = kPumpCount;  ///< How many there are of them; the others stay at nothing.
  std::array<PumpProfile, kPumpCount> pump;
  DigPath dig_path;
  double dig_speed_mps = 0.0;                        ///< Of the tip along the path.
  std::array<double, kPumpCount> dig_swash_ratio{};  ///< What the pumps are told to be at,
  SwashRange demand_swash;                           ///< unless it goes by what is needed.
  ControlProfile control;
  OilProfile oil;
  SensorZeros sensor_zero;
  ImuProfile imu;  ///< Without any, strokes are measured.
  SecondSensors second;
  SafetyProfile safety;
  MarkProfile mark;

  [[nodiscard]] bool has_swing() const { return drive_count == kDriveCount; }
  /// Angles of joints or links come late, and count as of the time of their frames.
  [[nodiscard]] bool foretells_joints() const {
    return imu.known() || (bus.joint_angles && bus.joint_latency_s > 0.0);
  }
};

}  // namespace graben
