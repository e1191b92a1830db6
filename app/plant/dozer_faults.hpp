// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Faults of the simulated dozer, beside those of every machine.

#include <array>
#include <optional>

#include "app/plant/dozer_hst_path.hpp"
#include "app/plant/node_faults.hpp"
#include "firmware/dozer/dozer_signals.hpp"

namespace graben::plant {

/// Of the body's pose and its rates, each as its sensor shows it; lengths in m, angles in rad.
struct PoseFaults {
  ReadingFault position;
  ReadingFault height;
  ReadingFault pitch;
  ReadingFault velocity;
  ReadingFault climb;
  ReadingFault pitch_rate;
  ReadingFault roll;  ///< Of a machine whose blade tilts, as the next.
  ReadingFault roll_rate;
  ReadingFault offset;  ///< On a design whose track curves, as the next.
  ReadingFault heading;
  ReadingFault yaw_rate;
  /// All of them come that much later each second, s/s, from 0 on; 0 takes it back.
  double later_ps = 0.0;

  [[nodiscard]] std::array<ReadingFault*, 11> all() {
    return {&position, &height,    &pitch,  &velocity, &climb,   &pitch_rate,
            &roll,     &roll_rate, &offset, &heading,  &yaw_rate};
  }

  /// The whole sensor: a total station that has lost its prism, an inertial unit that has died.
  void set_state(dbc::RawState state) {
    for (ReadingFault* fault : all()) {
      fault->state = state;
    }
  }
};

/// Of one path of the transmission.
struct PathFaults {
  DisplacementFault pump;
  DisplacementFault motor;
  std::optional<double> shown_pump_ratio;  ///< What the feedback says.
  std::optional<double> shown_motor_ratio;
  ReadingFault speed;  ///< Of the track, m/s.
};

struct DozerFaults : NodeFaults {
  StrokeFault stroke;
  StrokeFault tilt_stroke;
  std::optional<double> tilt_spool_held_ratio;  ///< As the blade's below.
  /// The pilot valve is stuck and holds the spool here, -1 .. 1. Only the pilot cut centres it.
  std::optional<double> spool_held_ratio;
  /// The spool opens that much beyond its command, neutral or not.
  double spool_offset_ratio = 0.0;
  /// Hoses or valve are reversed: its oil goes the other way, its sensor shows what was commanded.
  bool reversed = false;
  bool echoes = false;  ///< Its sensor shows what it is sent.
  PoseFaults pose;
  std::array<PathFaults, kTrackCount> path;
  /// PumpDisplacementCommand and MotorDisplacementCommand do not reach the machine.
  bool loses_displacement_commands = false;
  /// Both pumps stay where they were told to be as this began; the brake obeys.
  bool pumps_stay = false;
  bool pump_feedback_echoes = false;  ///< It shows what the pumps are told.
  bool pump_feedback_stuck = false;   ///< It shows what it showed as this began.
};

}  // namespace graben::plant
