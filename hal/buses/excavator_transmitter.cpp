#include "hal/buses/excavator_transmitter.hpp"

#include <cmath>

#include "can_dbc/generated/excavator_dbc.hpp"
#include "hal/buses/bus_codes.hpp"
#include "hal/link/message_encode.hpp"

namespace graben {

template struct BusCodes<dbc::excavator::EcuStatus, dbc::excavator::EcuHealth>;
template struct TaskLimitCodes<dbc::excavator::EcuStatus>;
template struct StepCodes<dbc::excavator::TaskStatus>;

namespace {

namespace bus = dbc::excavator;

static_assert(same_code(bus::EcuStatus::kLimitKind.raw_max, LimitKind::kOffPath));

bool may_move(const ExcavatorOutputs& outputs) {
  bool finite = true;
  for (const double duty_ratio : outputs.duty_ratio) {
    finite = finite && std::isfinite(duty_ratio);
  }
  return outputs.enable && finite;
}

bus::SpoolCommand spool_command(const ExcavatorOutputs& outputs, const EcuDiagnosis&) {
  bus::SpoolCommand message;  // its start values are Off, neutral and no cut
  set_pilot_cut(message, outputs);
  if (may_move(outputs)) {
    message.enable = coded<bus::SpoolCommand::Enable>(bus::SpoolCommand::Enable::kOn);
    message.boom_duty_ratio = physical(outputs.duty_ratio[0]);
    message.arm_duty_ratio = physical(outputs.duty_ratio[1]);
    message.bucket_duty_ratio = physical(outputs.duty_ratio[2]);
  }
  return message;
}

bus::SwingCommand swing_command(const ExcavatorOutputs& outputs, const EcuDiagnosis&) {
  bus::SwingCommand message;  // its start values are Off and neutral
  if (may_move(outputs)) {
    message.enable = coded<bus::SwingCommand::Enable>(bus::SwingCommand::Enable::kOn);
    message.swing_duty_ratio = physical(outputs.duty_ratio[3]);
  }
  return message;
}

/// 0 is not a swash that a pump of this machine can be wanted at: nothing is commanded.
bool is_swash(double swash_ratio) { return std::isfinite(swash_ratio) && swash_ratio > 0.0; }

bus::PumpCommand pump_command(const ExcavatorOutputs& outputs, const EcuDiagnosis&) {
  bus::PumpCommand message;  // its start values are 'not available'
  if (may_move(outputs) && is_swash(outputs.swash_ratio[0])) {
    message.pump1_swash_ratio = physical(outputs.swash_ratio[0]);
  }
  if (may_move(outputs) && is_swash(outputs.swash_ratio[1])) {
    message.pump2_swash_ratio = physical(outputs.swash_ratio[1]);
  }
  return message;
}

bus::EcuMotion ecu_motion(const ExcavatorOutputs& outputs, const EcuDiagnosis&) {
  const ExcavatorStatus& status = outputs.status;
  bus::EcuMotion message;
  message.boom_wanted_velocity_mps = physical(status.wanted_velocity_mps[0]);
  message.arm_wanted_velocity_mps = physical(status.wanted_velocity_mps[1]);
  message.bucket_wanted_velocity_mps = physical(status.wanted_velocity_mps[2]);
  return message;
}

bus::EcuHydraulics ecu_hydraulics(const ExcavatorOutputs& outputs, const EcuDiagnosis&) {
  const ExcavatorStatus& status = outputs.status;
  bus::EcuHydraulics message;
  message.pump1_expected_pressure_pa = physical(status.pump_pressure_pa[0]);
  message.pump2_expected_pressure_pa = physical(status.pump_pressure_pa[1]);
  message.path_error_m = physical(status.path_error_m);
  return message;
}

bus::TaskStatus task_status(const ExcavatorOutputs& outputs, const EcuDiagnosis&) {
  const TaskProgress& progress = outputs.status.progress;
  bus::TaskStatus message;  // its start values say that no task runs
  if (progress.runs) {
    message.task_number = count(progress.number);
    message.step = count(progress.step);
    message.step_kind = coded<bus::TaskStatus::StepKind>(progress.kind);
    message.progress = physical(progress.share);
  }
  message.swing_wanted_velocity_radps = physical(outputs.status.swing_wanted_radps);
  return message;
}

template <class Message, Message (*make)(const ExcavatorOutputs&, const EcuDiagnosis&)>
constexpr auto row(TimeUs phase_us, BusPart part = nullptr) {
  return send_row<ExcavatorOutputs, Message, make>(phase_us, part);
}

constexpr auto kTable = send_table<bus::DM1>(
    row<bus::SpoolCommand, spool_command>(0),
    row<bus::SwingCommand, swing_command>(0, &BusParts::swing_drive),
    row<bus::PumpCommand, pump_command>(0), row<bus::EcuStatus, ecu_status<bus::EcuStatus>>(0),
    row<bus::EcuMotion, ecu_motion>(kControlPeriod_us),
    row<bus::EcuHydraulics, ecu_hydraulics>(kControlPeriod_us),
    row<bus::TaskStatus, task_status>(kControlPeriod_us, &BusParts::swing_drive),
    row<bus::EcuHealth, ecu_health<bus::EcuHealth>>(5 * kControlPeriod_us),
    row<bus::EcuIdentity, ecu_identity<bus::EcuIdentity, bus::kDbcVersion>>(0));

}  // namespace

const SendTable<ExcavatorOutputs, ExcavatorTransmission::kPeriodicCount>&
ExcavatorTransmission::table() {
  return kTable;
}

}  // namespace graben
