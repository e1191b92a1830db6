// SPDX-License-Identifier: Apache-2.0
#include "hal/buses/common_messages.hpp"

#include <algorithm>

namespace graben {
namespace {

namespace bus = dbc::common;

// The tables of the DBC and of the core, number by number where they do not come from one file.
using BusMode = bus::EcuStatus::Mode;
static_assert(same_code(BusMode::kSilent, EcuMode::kSilent));
static_assert(same_code(BusMode::kReady, EcuMode::kReady));
static_assert(same_code(BusMode::kArmed, EcuMode::kArmed));
static_assert(same_code(BusMode::kActive, EcuMode::kActive));
static_assert(same_code(BusMode::kStopping, EcuMode::kStopping));
static_assert(same_code(BusMode::kFault, EcuMode::kFault));
static_assert(same_code(bus::EcuStatus::kMode.raw_max, EcuMode::kFault));

using BusOperatorMode = bus::OperatorCommand::OperatorMode;
static_assert(same_code(BusOperatorMode::kManual, OperatorMode::kManual));
static_assert(same_code(BusOperatorMode::kAutomatic, OperatorMode::kAutomatic));
static_assert(same_code(bus::OperatorCommand::kOperatorMode.raw_max, OperatorMode::kAutomatic));

using BusTask = bus::OperatorCommand::Task;
static_assert(same_code(BusTask::kNone, Task::kNone));
static_assert(same_code(BusTask::kDig, Task::kDig));
static_assert(same_code(BusTask::kGrade, Task::kGrade));
static_assert(same_code(BusTask::kProgram, Task::kProgram));
static_assert(same_code(BusTask::kJog, Task::kJog));
static_assert(same_code(BusTask::kCoordinated, Task::kCoordinated));
static_assert(same_code(BusTask::kCommission, Task::kCommission));
static_assert(same_code(BusTask::kAssist, Task::kAssist));
static_assert(same_code(bus::OperatorCommand::kTask.raw_max, Task::kAssist));

using BusMark = bus::EcuChecks::Result;
static_assert(same_code(BusMark::kNoMark, MarkResult::kNoMark));
static_assert(same_code(BusMark::kNever, MarkResult::kNever));
static_assert(same_code(BusMark::kPassed, MarkResult::kPassed));
static_assert(same_code(BusMark::kMissed, MarkResult::kMissed));
static_assert(same_code(bus::EcuChecks::kResult.raw_max, MarkResult::kMissed));
using BusTouch = bus::EcuChecks::Touch;
static_assert(same_code(BusTouch::kNone, MarkTouch::kNone));
static_assert(same_code(BusTouch::kTaken, MarkTouch::kTaken));
static_assert(same_code(BusTouch::kMoving, MarkTouch::kMoving));
static_assert(same_code(BusTouch::kNotByHand, MarkTouch::kNotByHand));
static_assert(same_code(BusTouch::kNotKnown, MarkTouch::kNotKnown));
static_assert(same_code(BusTouch::kNoPoint, MarkTouch::kNoPoint));
static_assert(same_code(BusTouch::kContradict, MarkTouch::kContradict));
static_assert(same_code(bus::EcuChecks::kTouch.raw_max, MarkTouch::kContradict));
using BusPoint = bus::TouchedPoint::Kind;
static_assert(same_code(BusPoint::kMark, TouchKind::kMark));
static_assert(same_code(BusPoint::kBenchmark, TouchKind::kBenchmark));
static_assert(same_code(BusPoint::kHeading, TouchKind::kHeading));
static_assert(same_code(BusPoint::kSurface, TouchKind::kSurface));
static_assert(same_code(BusPoint::kMoved, TouchKind::kMoved));
static_assert(same_code(bus::TouchedPoint::kKind.raw_max, TouchKind::kMoved));

using BusLevel = bus::ExternalLimit::Level;
static_assert(same_code(BusLevel::kFree, ExternalLevel::kFree));
static_assert(same_code(BusLevel::kSlow, ExternalLevel::kSlow));
static_assert(same_code(BusLevel::kStop, ExternalLevel::kStop));
static_assert(same_code(bus::ExternalLimit::kLevel.raw_max, ExternalLevel::kStop));

// faults.toml and limits.toml are behind both sides of these.
static_assert(bus::EcuStatus::kFault.raw_max == kFaultCount - 1);
static_assert(bus::EcuStatus::kLimitKind.raw_max == kLimitKindCount - 1);
static_assert(bus::EcuHealth::kWhyNotArmed.raw_max == UINT32_MAX && kArmBlockCount <= 32);
static_assert(same_code(bus::EcuStatus::Fault::kStalled, Fault::kStalled));
static_assert(same_code(bus::EcuStatus::LimitKind::kOffPath, LimitKind::kOffPath));
// For LimitKind::kDegraded the index is a fault's number.
static_assert(bus::EcuStatus::kLimitIndex.raw_max >= kFaultCount - 1);
static_assert(kDm1FirstSpn + kFaultCount <= 524288U);

static_assert((bus::EcuStatus::kId & 0xFFU) == kOwnAddress);

constexpr std::uint32_t non_negative(TimeUs time_us) {
  const TimeUs low = time_us < 0 ? 0 : time_us;
  return low > UINT32_MAX ? UINT32_MAX : static_cast<std::uint32_t>(low);
}

}  // namespace

void store_operator(const bus::OperatorCommand& message, TimeUs now, OperatorInputs& to) {
  put(to.enable, message.enable, now);
  put(to.mode, message.operator_mode, now);
  put(to.task, message.task, now);
  put(to.speed_override_ratio, message.speed_override_ratio, now);
  put(to.task_number, message.task_number, now);
}

void store_external(const bus::ExternalLimit& message, TimeUs now, Signal<ExternalWord>& to) {
  constexpr double kDeadline_s = 0.25;
  const auto valid = [](const auto& signal) { return signal.state == dbc::RawState::kValid; };
  to = {{}, validity_of(message.level.state), now};
  to.value.level = static_cast<ExternalLevel>(message.level.value);
  to.value.resumes =
      valid(message.resume) && message.resume.value == bus::ExternalLimit::Resume::kOn;
  to.value.source = static_cast<std::uint8_t>(message.source.value);
  to.value.speed_ratio = message.speed_share_ratio.value;
  to.value.deadline_s = valid(message.deadline_s) ? message.deadline_s.value : kDeadline_s;
  if (to.value.level == ExternalLevel::kSlow && !valid(message.speed_share_ratio)) {
    to.validity = std::min(to.validity, validity_of(message.speed_share_ratio.state));
  }
}

void store_touch(const bus::TouchedPoint& message, TimeUs now, Signal<TouchWord>& to) {
  to = {
      {static_cast<std::uint8_t>(message.number.value), static_cast<TouchKind>(message.kind.value)},
      std::min(validity_of(message.number.state), validity_of(message.kind.state)),
      now};
}

void store_identity(const bus::MachineIdentity& message, TimeUs now, PartnerIdentity& to) {
  put(to.profile_hash, message.profile_hash, now);
  put(to.dbc_version, message.dbc_version, now);
}

bus::EcuStatus ecu_status(const MachineStatus& status, const EcuDiagnosis& diagnosis) {
  bus::EcuStatus message;
  message.mode = coded<bus::EcuStatus::Mode>(status.mode);
  message.limit_kind = coded<bus::EcuStatus::LimitKind>(status.limit.kind);
  message.limit_index = count(status.limit.index);
  message.lambda = physical(status.lambda);
  message.fault = coded<bus::EcuStatus::Fault>(status.fault);
  message.cycle_time_us = count(non_negative(diagnosis.cycle_time_us));
  message.rejected_frames = count(diagnosis.rejected_frames);
  return message;
}

bus::EcuHealth ecu_health(const MachineStatus& status, const EcuDiagnosis& diagnosis) {
  const ProcessHealth& process = diagnosis.process;
  bus::EcuHealth message;
  message.why_not_armed = count(status.why_not_armed);
  message.allocations = count(process.allocations);
  message.page_faults = count(process.page_faults);
  message.overruns = count(process.overruns);
  message.dropped_frames = count(diagnosis.dropped_frames);
  message.real_time = coded<bus::EcuHealth::RealTime>(process.real_time ? 1 : 0);
  message.stand_in = coded<bus::EcuHealth::StandIn>(status.stand_in ? 1 : 0);
  return message;
}

bus::EcuIdentity ecu_identity(const EcuDiagnosis& diagnosis, std::uint8_t dbc_version) {
  bus::EcuIdentity message;
  message.profile_hash = count(diagnosis.profile_hash);
  message.dbc_version = count(dbc_version);
  message.stamp = count(diagnosis.stamp);
  return message;
}

bus::EcuChecks ecu_checks(const MarkTold& mark) {
  bus::EcuChecks message;  // its start values are 'not available'
  message.result = coded<bus::EcuChecks::Result>(mark.result);
  message.touch = coded<bus::EcuChecks::Touch>(mark.touch);
  if (mark.result == MarkResult::kNoMark) {
    return message;
  }
  message.tolerance_m = physical(mark.tolerance_m);
  message.checks = count(mark.count);
  if (mark.count > 0) {
    message.age_s = physical(mark.age_s);
    message.off_outwards_m = physical(mark.off_m.x());
    message.off_across_m = physical(mark.off_m.y());
    message.off_up_m = physical(mark.off_m.z());
  }
  return message;
}

dbc::Payload encode_trouble(const Dm1Content& content) {
  bus::DM1 message;
  message.amber_warning_lamp = coded<bus::DM1::AmberWarningLamp>(content.amber_warning ? 1 : 0);
  message.red_stop_lamp = coded<bus::DM1::RedStopLamp>(content.red_stop ? 1 : 0);
  message.spn_low = count(content.spn & 0xFFFFU);
  message.spn_high = count(content.spn >> 16U);
  message.fmi = count(content.fmi);
  message.occurrence_count = count(content.occurrences);
  return SignalRows<dbc::MessageList<bus::DM1>>::encode(message);
}

}  // namespace graben
