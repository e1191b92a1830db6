// SPDX-License-Identifier: Apache-2.0
#include "hal/buses/dozer_bus.hpp"

#include <algorithm>
#include <cmath>

#include "can_dbc/generated/dozer_dbc.hpp"
#include "hal/buses/common_messages.hpp"

namespace graben {
namespace {

namespace bus = dbc::dozer;

/// Either path; its line pressure is for diagnosis only.
template <class Transmission>
void put_transmission(TrackInputs& track, const Transmission& message, TimeUs now) {
  put(track.pump_ratio, message.pump_ratio, now);
  put(track.motor_ratio, message.motor_ratio, now);
  put(track.line_pressure_pa, message.line_pressure_pa, now);
}

void put_try(const bus::DozerTry& message, TimeUs now, Signal<DozerTry>& to) {
  // Together one thing that is asked for: none of it counts without the rest.
  const Validity validity =
      std::min({validity_of(message.drive.state), validity_of(message.ratio_ratio.state),
                validity_of(message.motor_ratio.state)});
  to = {{static_cast<TriedDrive>(message.drive.value), message.ratio_ratio.value,
         message.motor_ratio.value},
        validity,
        now};
}

void put_window(const bus::DozerWindow& message, TimeUs now, DozerInputs& to) {
  const auto drive = static_cast<unsigned>(message.drive.value);
  const bool valid = message.drive.state == dbc::RawState::kValid &&
                     message.least_m.state == dbc::RawState::kValid &&
                     message.most_m.state == dbc::RawState::kValid &&
                     message.most_speed_mps.state == dbc::RawState::kValid;
  to.window[drive] = {{message.least_m.value, message.most_m.value, message.most_speed_mps.value},
                      valid ? Validity::kValid : Validity::kNotAvailable,
                      now};
}

struct Store : CommonStore<DozerInputs, Task::kGrade, Task::kCommission> {
  using CommonStore::store;

  static void store(const bus::BladeStroke& message, TimeUs now, To& to) {
    put(to.inputs.blade_stroke_m, message.blade_stroke_m, now);
  }
  static void store(const bus::BodyPosition& message, TimeUs now, To& to) {
    put(to.inputs.body.position_m, message.position_m, now);
    put(to.inputs.body.height_m, message.height_m, now);
  }
  static void store(const bus::BodyPitch& message, TimeUs now, To& to) {
    put(to.inputs.body.pitch_rad, message.pitch_rad, now);
    put(to.inputs.body.pitch_rate_radps, message.pitch_rate_radps, now);
  }
  static void store(const bus::BodyVelocity& message, TimeUs now, To& to) {
    put(to.inputs.body.velocity_mps, message.forward_mps, now);
    put(to.inputs.body.climb_mps, message.climb_mps, now);
  }
  static void store(const bus::LeftTransmission& message, TimeUs now, To& to) {
    put_transmission(to.inputs.track[kLeft], message, now);
  }
  static void store(const bus::RightTransmission& message, TimeUs now, To& to) {
    put_transmission(to.inputs.track[kRight], message, now);
  }
  static void store(const bus::TiltState& message, TimeUs now, To& to) {
    put(to.inputs.tilt_stroke_m, message.tilt_stroke_m, now);
    put(to.inputs.body.roll_rad, message.roll_rad, now);
    put(to.inputs.body.roll_rate_radps, message.roll_rate_radps, now);
  }
  static void store(const bus::BodyCourse& message, TimeUs now, To& to) {
    put(to.inputs.body.offset_m, message.offset_m, now);
    put(to.inputs.body.heading_rad, message.heading_rad, now);
    put(to.inputs.body.yaw_rate_radps, message.yaw_rate_radps, now);
  }
  static void store(const bus::TrackSpeed& message, TimeUs now, To& to) {
    put(to.inputs.track[kLeft].speed_mps, message.left_track_mps, now);
    put(to.inputs.track[kRight].speed_mps, message.right_track_mps, now);
  }
  static void store(const bus::ValveState& message, TimeUs now, To& to) {
    put(to.inputs.blade_spool_ratio, message.blade_spool_ratio, now);
    put(to.inputs.tilt_spool_ratio, message.tilt_spool_ratio, now);
    put(to.inputs.valve_enabled, message.enabled, now);
  }
  static void store(const bus::DozerTry& message, TimeUs now, To& to) {
    put_try(message, now, to.inputs.tried);
  }
  static void store(const bus::DozerWindow& message, TimeUs now, To& to) {
    put_window(message, now, to.inputs);
  }
};

using OwnReceived =
    dbc::MessageList<bus::BladeStroke, bus::BodyPosition, bus::BodyPitch, bus::BodyVelocity,
                     bus::LeftTransmission, bus::RightTransmission, bus::TrackSpeed, bus::TiltState,
                     bus::BodyCourse, bus::ValveState, bus::DozerTry, bus::DozerWindow>;
constexpr auto kReceiveTable = receive_table<DozerInputs, Store>(
    OwnReceived{}, CommonReceived{}, kBusMessages<bus::kMessages>, bus::kDbcVersion);

bool may_move(const DozerOutputs& outputs) {
  bool finite = std::isfinite(outputs.blade_duty_ratio) && std::isfinite(outputs.tilt_duty_ratio);
  for (const auto& ratios : {outputs.pump_ratio, outputs.motor_ratio}) {
    finite = finite && std::isfinite(ratios[kLeft]) && std::isfinite(ratios[kRight]);
  }
  return outputs.enable && finite;
}

bus::SpoolCommand spool_command(const DozerOutputs& outputs, const EcuDiagnosis&) {
  bus::SpoolCommand message;  // its start values are Off, neutral and no cut
  set_pilot_cut(message, outputs);
  if (may_move(outputs)) {
    message.enable = coded<bus::SpoolCommand::Enable>(bus::SpoolCommand::Enable::kOn);
    message.blade_duty_ratio = physical(outputs.blade_duty_ratio);
  }
  if (outputs.tilts) {
    message.tilt_duty_ratio = physical(may_move(outputs) ? outputs.tilt_duty_ratio : 0.0);
  }
  return message;
}

bus::PumpDisplacementCommand pump_command(const DozerOutputs& outputs, const EcuDiagnosis&) {
  bus::PumpDisplacementCommand message;  // its start values are 0 and brake
  message.brake = coded<bus::PumpDisplacementCommand::Brake>(outputs.brake ? 1 : 0);
  if (may_move(outputs)) {
    message.left_pump_ratio = physical(outputs.pump_ratio[kLeft]);
    message.right_pump_ratio = physical(outputs.pump_ratio[kRight]);
  }
  return message;
}

bus::MotorDisplacementCommand motor_command(const DozerOutputs& outputs, const EcuDiagnosis&) {
  bus::MotorDisplacementCommand message;  // its start values are full displacement
  if (may_move(outputs)) {
    message.left_motor_ratio = physical(outputs.motor_ratio[kLeft]);
    message.right_motor_ratio = physical(outputs.motor_ratio[kRight]);
  }
  return message;
}

bus::EcuMotion ecu_motion(const DozerOutputs& outputs, const EcuDiagnosis&) {
  const DozerStatus& status = outputs.status;
  bus::EcuMotion message;
  message.wanted_speed_mps = physical(status.wanted_speed_mps);
  message.speed_limit_mps = physical(status.speed_limit_mps);
  message.wanted_blade_velocity_mps = physical(status.wanted_blade_mps);
  if (outputs.tilts) {
    message.wanted_tilt_velocity_mps = physical(status.wanted_tilt_mps);
  }
  return message;
}

bus::EcuGrade ecu_grade(const DozerOutputs& outputs, const EcuDiagnosis&) {
  const DozerStatus& status = outputs.status;
  bus::EcuGrade message;
  message.required_flow_m3ps = physical(status.required_flow_m3ps);
  message.available_flow_m3ps = physical(status.available_flow_m3ps);
  message.grade_error_m = physical(status.grade_error_m);
  if (outputs.tilts) {
    message.cross_error_ratio = physical(status.cross_error);
  }
  return message;
}

template <class Message, Message (*make)(const DozerOutputs&, const EcuDiagnosis&)>
constexpr auto row(TimeUs phase_us) {
  return send_row<DozerOutputs, Message, make>(phase_us);
}

constexpr auto kSendTable = bus_send_table(
    row<bus::SpoolCommand, spool_command>(0), row<bus::PumpDisplacementCommand, pump_command>(0),
    row<bus::MotorDisplacementCommand, motor_command>(0), ecu_status_row<DozerOutputs>(),
    row<bus::EcuMotion, ecu_motion>(kControlPeriod_us),
    row<bus::EcuGrade, ecu_grade>(kControlPeriod_us), ecu_health_row<DozerOutputs>(),
    ecu_checks_row<DozerOutputs>(), ecu_identity_row<DozerOutputs, bus::kDbcVersion>());

}  // namespace

const ReceiveTable<DozerInputs, DozerReception::kMessageCount>& DozerReception::table() {
  return kReceiveTable;
}

const SendTable<DozerOutputs, DozerTransmission::kPeriodicCount>& DozerTransmission::table() {
  return kSendTable;
}

}  // namespace graben
