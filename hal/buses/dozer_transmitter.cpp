#include "hal/buses/dozer_transmitter.hpp"

#include <cmath>

#include "can_dbc/generated/dozer_dbc.hpp"
#include "hal/buses/bus_codes.hpp"
#include "hal/link/message_encode.hpp"

namespace graben {

template struct BusCodes<dbc::dozer::EcuStatus, dbc::dozer::EcuHealth>;

namespace {

namespace bus = dbc::dozer;

using BusLimit = bus::EcuStatus::LimitKind;
static_assert(same_code(BusLimit::kImplementFlow, LimitKind::kImplementFlow));
static_assert(same_code(BusLimit::kTransmissionFlow, LimitKind::kTransmissionFlow));
static_assert(same_code(BusLimit::kAhead, LimitKind::kAhead));
static_assert(same_code(BusLimit::kOffGrade, LimitKind::kOffGrade));
static_assert(same_code(bus::EcuStatus::kLimitKind.raw_max, LimitKind::kOffGrade));

bool may_move(const DozerOutputs& outputs) {
  bool finite = std::isfinite(outputs.blade_duty_ratio);
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
  return message;
}

bus::EcuGrade ecu_grade(const DozerOutputs& outputs, const EcuDiagnosis&) {
  const DozerStatus& status = outputs.status;
  bus::EcuGrade message;
  message.required_flow_m3ps = physical(status.required_flow_m3ps);
  message.available_flow_m3ps = physical(status.available_flow_m3ps);
  message.grade_error_m = physical(status.grade_error_m);
  return message;
}

template <class Message, Message (*make)(const DozerOutputs&, const EcuDiagnosis&)>
constexpr auto row(TimeUs phase_us) {
  return send_row<DozerOutputs, Message, make>(phase_us);
}

constexpr auto kTable = send_table<bus::DM1>(
    row<bus::SpoolCommand, spool_command>(0), row<bus::PumpDisplacementCommand, pump_command>(0),
    row<bus::MotorDisplacementCommand, motor_command>(0),
    row<bus::EcuStatus, ecu_status<bus::EcuStatus>>(0),
    row<bus::EcuMotion, ecu_motion>(kControlPeriod_us),
    row<bus::EcuGrade, ecu_grade>(kControlPeriod_us),
    row<bus::EcuHealth, ecu_health<bus::EcuHealth>>(5 * kControlPeriod_us),
    row<bus::EcuIdentity, ecu_identity<bus::EcuIdentity, bus::kDbcVersion>>(0));

}  // namespace

const SendTable<DozerOutputs, DozerTransmission::kPeriodicCount>& DozerTransmission::table() {
  return kTable;
}

}  // namespace graben
