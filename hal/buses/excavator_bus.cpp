// SPDX-License-Identifier: Apache-2.0
#include "hal/buses/excavator_bus.hpp"

#include <algorithm>

#include <cmath>

#include "can_dbc/generated/excavator_dbc.hpp"
#include "firmware/excavator/fences/site_frame.hpp"
#include "hal/buses/common_messages.hpp"
#include "hal/buses/may_move.hpp"

namespace graben {
namespace {

namespace bus = dbc::excavator;

// What the steps of an excavator's tasks are for.
using BusStep = bus::TaskStatus::StepKind;
static_assert(same_code(BusStep::kNone, StepKind::kNone));
static_assert(same_code(BusStep::kApproach, StepKind::kApproach));
static_assert(same_code(BusStep::kDig, StepKind::kDig));
static_assert(same_code(BusStep::kLift, StepKind::kLift));
static_assert(same_code(BusStep::kSwing, StepKind::kSwing));
static_assert(same_code(BusStep::kDump, StepKind::kDump));
static_assert(same_code(BusStep::kReturnToDig, StepKind::kReturnToDig));
static_assert(same_code(BusStep::kDone, StepKind::kDone));
static_assert(same_code(BusStep::kWait, StepKind::kWait));
static_assert(same_code(bus::TaskStatus::kStepKind.raw_max, StepKind::kWait));

using BusFrame = bus::EcuMotion::Frame;
static_assert(same_code(BusFrame::kNone, SiteKnown::kNone));
static_assert(same_code(BusFrame::kUnknown, SiteKnown::kUnknown));
static_assert(same_code(BusFrame::kBenchmark, SiteKnown::kBenchmark));
static_assert(same_code(BusFrame::kKnown, SiteKnown::kKnown));
static_assert(same_code(bus::EcuMotion::kFrame.raw_max, SiteKnown::kKnown));

using BusAssist = bus::EcuMotion::Assist;
static_assert(same_code(BusAssist::kNone, AssistState::kNone));
static_assert(same_code(BusAssist::kAway, AssistState::kAway));
static_assert(same_code(BusAssist::kNear, AssistState::kNear));
static_assert(same_code(BusAssist::kHolds, AssistState::kHolds));
static_assert(same_code(BusAssist::kLetGo, AssistState::kLetGo));
static_assert(same_code(BusAssist::kBeyond, AssistState::kBeyond));
static_assert(same_code(bus::EcuMotion::kAssist.raw_max, AssistState::kBeyond));

void put_pressures(AxisInputs& axis, const dbc::Physical& cap, const dbc::Physical& rod,
                   TimeUs now) {
  put(axis.cap_pressure_pa, cap, now);
  put(axis.rod_pressure_pa, rod, now);
}

/// Values that are used together: one sensor's error is all of them's. What is not there is 0.
template <class... Raw>
void put_all(Signal<std::array<double, sizeof...(Raw)>>& to, TimeUs now, const Raw&... raw) {
  const bool wrong = (... || (raw.state == dbc::RawState::kError));
  to = {{raw.value...}, wrong ? Validity::kError : Validity::kValid, now};
}

void put_window(const bus::CommissionWindow& message, TimeUs now, ExcavatorInputs& to) {
  const auto drive = static_cast<unsigned>(message.drive.value);
  const bool valid = message.drive.state == dbc::RawState::kValid &&
                     message.least_stroke_m.state == dbc::RawState::kValid &&
                     message.most_stroke_m.state == dbc::RawState::kValid &&
                     message.most_speed_mps.state == dbc::RawState::kValid;
  to.window[drive] = {
      {message.least_stroke_m.value, message.most_stroke_m.value, message.most_speed_mps.value},
      valid ? Validity::kValid : Validity::kNotAvailable,
      now};
}

struct Store : CommonStore<ExcavatorInputs, Task::kDig, Task::kProgram, Task::kJog,
                           Task::kCoordinated, Task::kCommission, Task::kAssist> {
  using CommonStore::part;
  using CommonStore::store;

  static constexpr BusPart part(const bus::SwingState&) { return &BusParts::swing_drive; }
  static constexpr BusPart part(const bus::SwingValveState&) { return &BusParts::swing_drive; }
  static constexpr BusPart part(const bus::SecondStrokes&) { return &BusParts::second_strokes; }
  static constexpr BusPart part(const bus::SecondSwing&) { return &BusParts::second_swing; }
  static constexpr BusPart part(const bus::BoomStroke&) { return &BusParts::own_machine; }
  static constexpr BusPart part(const bus::ArmStroke&) { return &BusParts::own_machine; }
  static constexpr BusPart part(const bus::BucketStroke&) { return &BusParts::own_machine; }
  static constexpr BusPart part(const bus::BoomPressure&) { return &BusParts::own_machine; }
  static constexpr BusPart part(const bus::ArmPressure&) { return &BusParts::own_machine; }
  static constexpr BusPart part(const bus::BucketPressure&) { return &BusParts::own_machine; }
  static constexpr BusPart part(const bus::PumpState&) { return &BusParts::own_machine; }
  static constexpr BusPart part(const bus::ValveState&) { return &BusParts::own_machine; }
  static constexpr BusPart part(const dbc::common::MachineIdentity&) {
    return &BusParts::own_machine;
  }
  static constexpr BusPart part(const dbc::common::EEC1&) { return &BusParts::own_engine; }

  static void store(const bus::BoomStroke& message, TimeUs now, To& to) {
    put(to.inputs.axis[0].stroke_m, message.boom_stroke_m, now);
  }
  static void store(const bus::ArmStroke& message, TimeUs now, To& to) {
    put(to.inputs.axis[1].stroke_m, message.arm_stroke_m, now);
  }
  static void store(const bus::BucketStroke& message, TimeUs now, To& to) {
    put(to.inputs.axis[2].stroke_m, message.bucket_stroke_m, now);
  }
  static void store(const bus::BoomPressure& message, TimeUs now, To& to) {
    put_pressures(to.inputs.axis[0], message.boom_cap_pressure_pa, message.boom_rod_pressure_pa,
                  now);
  }
  static void store(const bus::ArmPressure& message, TimeUs now, To& to) {
    put_pressures(to.inputs.axis[1], message.arm_cap_pressure_pa, message.arm_rod_pressure_pa, now);
  }
  static void store(const bus::BucketPressure& message, TimeUs now, To& to) {
    put_pressures(to.inputs.axis[2], message.bucket_cap_pressure_pa, message.bucket_rod_pressure_pa,
                  now);
  }
  static void store(const bus::SwingState& message, TimeUs now, To& to) {
    put(to.inputs.swing.angle_rad, message.swing_angle_rad, now);
    put(to.inputs.swing.left_pressure_pa, message.swing_left_pressure_pa, now);
    put(to.inputs.swing.right_pressure_pa, message.swing_right_pressure_pa, now);
  }
  static void store(const bus::PumpState& message, TimeUs now, To& to) {
    put(to.inputs.swash_ratio[0], message.pump1_swash_ratio, now);
    put(to.inputs.swash_ratio[1], message.pump2_swash_ratio, now);
  }
  static void store(const bus::ValveState& message, TimeUs now, To& to) {
    put(to.inputs.axis[0].spool_ratio, message.boom_spool_ratio, now);
    put(to.inputs.axis[1].spool_ratio, message.arm_spool_ratio, now);
    put(to.inputs.axis[2].spool_ratio, message.bucket_spool_ratio, now);
    put(to.inputs.valve_enabled, message.enabled, now);
  }
  static void store(const bus::SwingValveState& message, TimeUs now, To& to) {
    put(to.inputs.swing.spool_ratio, message.swing_spool_ratio, now);
  }
  static void store(const bus::SecondStrokes& message, TimeUs now, To& to) {
    put(to.inputs.second_stroke_m[0], message.boom_stroke_m, now);
    put(to.inputs.second_stroke_m[1], message.arm_stroke_m, now);
    put(to.inputs.second_stroke_m[2], message.bucket_stroke_m, now);
  }
  static void store(const bus::SecondSwing& message, TimeUs now, To& to) {
    put(to.inputs.second_swing_rad, message.swing_angle_rad, now);
  }
  static void store(const bus::OperatorAxes& message, TimeUs now, To& to) {
    put_all(to.inputs.lever_ratio, now, message.boom_or_up_ratio, message.arm_or_forward_ratio,
            message.bucket_or_attitude_ratio, message.swing_ratio);
  }
  static void store(const bus::CommissionDuty& message, TimeUs now, To& to) {
    put_all(to.inputs.tried_ratio, now, message.boom_duty_ratio, message.arm_duty_ratio,
            message.bucket_duty_ratio);
  }
  static void store(const bus::CommissionWindow& message, TimeUs now, To& to) {
    put_window(message, now, to.inputs);
  }
};

using OwnReceived =
    dbc::MessageList<bus::BoomStroke, bus::ArmStroke, bus::BucketStroke, bus::BoomPressure,
                     bus::ArmPressure, bus::BucketPressure, bus::PumpState, bus::ValveState,
                     bus::SwingState, bus::SwingValveState, bus::OperatorAxes, bus::CommissionDuty,
                     bus::CommissionWindow, bus::SecondStrokes, bus::SecondSwing>;
constexpr auto kReceiveTable = receive_table<ExcavatorInputs, Store>(
    OwnReceived{}, CommonReceived{}, kBusMessages<bus::kMessages>, bus::kDbcVersion);

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
  message.frame = coded<bus::EcuMotion::Frame>(status.site);
  message.assist = {static_cast<bus::EcuMotion::Assist>(status.assist), dbc::RawState::kValid};
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
    message.not_arrived = count(progress.missed);
  }
  if (outputs.status.swings) {
    message.swing_wanted_velocity_radps = physical(outputs.status.swing_wanted_radps);
  } else {
    message.swing_wanted_velocity_radps.state = dbc::RawState::kNotAvailable;
  }
  return message;
}

void put_edge(const LearntEdge& learnt, dbc::Physical& edge) {
  if (learnt.known) {  // its start value is 'not available'
    edge = physical(learnt.beyond_ratio);
  }
}

bus::EcuLearntValves learnt_valves(const ExcavatorOutputs& outputs, const EcuDiagnosis&) {
  const auto& edges = outputs.status.edges;
  bus::EcuLearntValves message;
  put_edge(edges[0].extend, message.boom_extend_edge_ratio);
  put_edge(edges[0].retract, message.boom_retract_edge_ratio);
  put_edge(edges[1].extend, message.arm_extend_edge_ratio);
  put_edge(edges[1].retract, message.arm_retract_edge_ratio);
  put_edge(edges[2].extend, message.bucket_extend_edge_ratio);
  put_edge(edges[2].retract, message.bucket_retract_edge_ratio);
  return message;
}

bus::EcuTipLoad tip_load(const ExcavatorOutputs& outputs, const EcuDiagnosis&) {
  const TipLoad& load = outputs.status.tip_load;
  bus::EcuTipLoad message;  // its start values are 'not available'
  if (load.known) {
    message.tip_force_outwards_n = physical(load.force_n.x());
    message.tip_force_up_n = physical(load.force_n.y());
    message.tip_force_deviation_n = physical(load.force_sd_n);
  }
  if (load.payload_known) {
    message.payload_mass_kg = physical(load.payload_kg);
    message.payload_deviation_kg = physical(load.payload_sd_kg);
  }
  return message;
}

template <class Message, Message (*make)(const ExcavatorOutputs&, const EcuDiagnosis&)>
constexpr auto row(TimeUs phase_us, BusPart part = nullptr) {
  return send_row<ExcavatorOutputs, Message, make>(phase_us, part);
}

constexpr auto kSendTable = bus_send_table(
    row<bus::SpoolCommand, spool_command>(0),
    row<bus::SwingCommand, swing_command>(0, &BusParts::swing_drive),
    row<bus::PumpCommand, pump_command>(0), ecu_status_row<ExcavatorOutputs>(),
    row<bus::EcuMotion, ecu_motion>(kControlPeriod_us),
    row<bus::EcuHydraulics, ecu_hydraulics>(kControlPeriod_us),
    row<bus::TaskStatus, task_status>(kControlPeriod_us),
    row<bus::EcuLearntValves, learnt_valves>(4 * kControlPeriod_us),
    row<bus::EcuTipLoad, tip_load>(6 * kControlPeriod_us), ecu_health_row<ExcavatorOutputs>(),
    ecu_checks_row<ExcavatorOutputs>(), ecu_identity_row<ExcavatorOutputs, bus::kDbcVersion>());

}  // namespace

int ExcavatorTransmitter::with_table(const Outputs& outputs, TimeUs now, int count, Frames& out) {
  TableTransmitter::Frames others;
  const std::size_t more = table_.frames(outputs, now, others);
  for (std::size_t n = 0; n < more; ++n) {
    out[static_cast<std::size_t>(count) + n] = others[n];
  }
  return count + static_cast<int>(more);
}

int ExcavatorTransmitter::with_commands(const Outputs& outputs, TimeUs now, int count,
                                        Frames& out) const {
  TableTransmitter::Frames others;
  const std::size_t first = table_.next_commands(outputs, now, others);
  for (auto n = static_cast<std::size_t>(count); n > 0; --n) {
    out[n - 1 + first] = out[n - 1];
  }
  for (std::size_t n = 0; n < first; ++n) {
    out[n] = others[n];
  }
  return count + static_cast<int>(first);
}

const ReceiveTable<ExcavatorInputs, ExcavatorReception::kMessageCount>&
ExcavatorReception::table() {
  return kReceiveTable;
}

const SendTable<ExcavatorOutputs, ExcavatorTransmission::kPeriodicCount>&
ExcavatorTransmission::table() {
  return kSendTable;
}

}  // namespace graben
