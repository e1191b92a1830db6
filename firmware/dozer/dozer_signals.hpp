// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Inputs and outputs of the dozer's controller. SI units; tracks in the order left,
/// right. World: x along the grade, z up. Body frame: x forward, z up, origin at the tracks' ground
/// line below the mass centre. Pitch is positive nose up. Extension of the blade cylinders is
/// positive and lowers the blade; their stroke counts from where the blade is raised fully.

#include <array>

#include "firmware/signals/machine_signals.hpp"

namespace graben {

/// Tracks of a dozer. [-; size: places of every array that has one value a track]
inline constexpr int kTrackCount = 2;
/// Place of the left track in such an array. [-; derived: tracks are in the order left, right]
inline constexpr unsigned kLeft = 0;
/// Place of the right track in such an array. [-; derived: tracks are in the order left, right]
inline constexpr unsigned kRight = 1;

/// One path of the transmission: pump, motor, sprocket.
struct TrackInputs {
  Signal<double> pump_ratio;   ///< Measured displacement over the largest, -1 .. 1; forward is +.
  Signal<double> motor_ratio;  ///< The same of the motor, 0 .. 1.
  Signal<double> line_pressure_pa;  ///< The higher of its two lines'.
  Signal<double> speed_mps;  ///< Of the track: sprocket's speed times its radius; forward is +.
};

/// The body's pose and its rates, all of the body frame's origin in the world.
struct BodyInputs {
  Signal<double> position_m;  ///< Along x.
  Signal<double> height_m;    ///< Along z.
  Signal<double> pitch_rad;
  Signal<double> velocity_mps;  ///< Along x.
  Signal<double> climb_mps;     ///< Along z.
  Signal<double> pitch_rate_radps;
  Signal<double> roll_rad;  ///< Left side up is positive; of a machine whose blade tilts.
  Signal<double> roll_rate_radps;
  // Of a design whose track curves, along which `position_m` is the station:
  Signal<double> offset_m;     ///< Left of the track.
  Signal<double> heading_rad;  ///< Against the track's direction beside it, to the left.
  Signal<double> yaw_rate_radps;
};

/// What Task::kCommission can try.
enum class TriedDrive : std::uint8_t { kNone = 0, kLift = 1, kTilt = 2, kTracks = 3 };
/// Drives that Task::kCommission has windows of. [-; size: lift, tilt, both tracks]
inline constexpr int kTriedCount = 3;

/// One drive at a time.
struct DozerTry {
  TriedDrive drive = TriedDrive::kNone;
  double ratio = 0.0;        ///< Duty of a spool, or displacement of both pumps, -1 .. 1.
  double motor_ratio = 1.0;  ///< Displacement of both motors.
};

struct DozerInputs : MachineInputs {
  Signal<double> blade_stroke_m;
  Signal<double> blade_spool_ratio;  ///< See DriveInputs.
  Signal<double> tilt_stroke_m;      ///< Of a machine whose blade tilts, as the next.
  Signal<double> tilt_spool_ratio;
  BodyInputs body;
  std::array<TrackInputs, kTrackCount> track;
  // Of Task::kCommission:
  Signal<DozerTry> tried;
  /// Of lift, tilt and tracks; of these m before and behind where they were tried first.
  std::array<Signal<StrokeWindow>, kTriedCount> window;
};

/// Status of the dozer's controller.
struct DozerStatus : MachineStatus {
  double wanted_speed_mps = 0.0;     ///< v_c of (14), after the acceleration limit.
  double speed_limit_mps = 0.0;      ///< (14) without v_d: what flow and transmission allow.
  double wanted_blade_mps = 0.0;     ///< Velocity of the blade cylinders; extension is positive.
  double wanted_tilt_mps = 0.0;      ///< The same of the tilt cylinder.
  double required_flow_m3ps = 0.0;   ///< Q_in of (7), of the measured motion.
  double available_flow_m3ps = 0.0;  ///< min of (12) and the valve's.
  double grade_error_m = 0.0;        ///< Measured cutting edge above the grade.
  double cross_error = 0.0;          ///< Its slope across over the design's; left up is positive.
  double off_track_m = 0.0;          ///< Its middle left of a track that curves.
  int pass = 1;                      ///< Over the design.
  bool cutting = true;               ///< In it; else on the way back to the next one.
  bool ground_left = false;          ///< This pass has left what another one has to take.
  bool graded = false;               ///< The last pass is done.
};

struct DozerOutputs : MachineOutputs {
  bool brake = true;  ///< Asks for the parking brake; also whenever nothing moves the machine.
  double blade_duty_ratio = 0.0;                             ///< -1 .. 1; 0 is neutral, + extends.
  double tilt_duty_ratio = 0.0;                              ///< The same.
  bool tilts = false;                                        ///< The machine has a tilt drive.
  std::array<double, kTrackCount> pump_ratio{};              ///< -1 .. 1; 0 stands still.
  std::array<double, kTrackCount> motor_ratio = {1.0, 1.0};  ///< motor_ratio_min .. 1.
  DozerStatus status;
};

}  // namespace graben
