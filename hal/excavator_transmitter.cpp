#include "hal/excavator_transmitter.hpp"

#include <cmath>

#include "can_dbc/generated/excavator_dbc.hpp"
#include "hal/e2e.hpp"

namespace graben {
namespace {

namespace bus = dbc::excavator;
using dbc::RawState;

template <class Bus, class Own>
constexpr bool same(Bus bus_code, Own own_code) {
  return static_cast<int>(bus_code) == static_cast<int>(own_code);
}

using BusMode = bus::EcuStatus::Mode;
static_assert(same(BusMode::kSilent, EcuMode::kSilent));
static_assert(same(BusMode::kReady, EcuMode::kReady));
static_assert(same(BusMode::kArmed, EcuMode::kArmed));
static_assert(same(BusMode::kActive, EcuMode::kActive));
static_assert(same(BusMode::kStopping, EcuMode::kStopping));
static_assert(same(BusMode::kFault, EcuMode::kFault));
static_assert(same(bus::EcuStatus::kMode.raw_max, EcuMode::kFault));

using BusLimit = bus::EcuStatus::LimitKind;
static_assert(same(BusLimit::kNone, LimitKind::kNone));
static_assert(same(BusLimit::kPumpFlow, LimitKind::kPumpFlow));
static_assert(same(BusLimit::kBackFlow, LimitKind::kBackFlow));
static_assert(same(BusLimit::kSpoolTravel, LimitKind::kSpoolTravel));
static_assert(same(BusLimit::kStrokeEnd, LimitKind::kStrokeEnd));
static_assert(same(BusLimit::kRise, LimitKind::kRise));
static_assert(same(BusLimit::kDegraded, LimitKind::kDegraded));
static_assert(same(bus::EcuStatus::kLimitKind.raw_max, LimitKind::kDegraded));

using BusFault = bus::EcuStatus::Fault;
static_assert(same(BusFault::kNone, Fault::kNone));
static_assert(same(BusFault::kStrokeMissing, Fault::kStrokeMissing));
static_assert(same(BusFault::kPressureMissing, Fault::kPressureMissing));
static_assert(same(BusFault::kSwashMissing, Fault::kSwashMissing));
static_assert(same(BusFault::kEngineSpeedMissing, Fault::kEngineSpeedMissing));
static_assert(same(BusFault::kOperatorMissing, Fault::kOperatorMissing));
static_assert(same(BusFault::kStrokeImplausible, Fault::kStrokeImplausible));
static_assert(same(BusFault::kPoseUnreachable, Fault::kPoseUnreachable));
static_assert(same(BusFault::kSolverFailed, Fault::kSolverFailed));
static_assert(same(BusFault::kCommandNotFinite, Fault::kCommandNotFinite));
static_assert(same(BusFault::kCycleStalled, Fault::kCycleStalled));
static_assert(same(BusFault::kIdentityMismatch, Fault::kIdentityMismatch));
static_assert(same(BusFault::kBusOff, Fault::kBusOff));
static_assert(same(BusFault::kBusPassive, Fault::kBusPassive));
static_assert(same(BusFault::kBusDown, Fault::kBusDown));
static_assert(same(BusFault::kTransmitFailed, Fault::kTransmitFailed));
static_assert(same(BusFault::kCycleOverrun, Fault::kCycleOverrun));
static_assert(same(BusFault::kMessageCorrupt, Fault::kMessageCorrupt));
static_assert(same(BusFault::kMessageSequence, Fault::kMessageSequence));
static_assert(same(BusFault::kMessageMasquerade, Fault::kMessageMasquerade));
static_assert(same(BusFault::kSpoolMissing, Fault::kSpoolMissing));
static_assert(same(BusFault::kSpoolStuck, Fault::kSpoolStuck));
static_assert(same(BusFault::kUncommandedMotion, Fault::kUncommandedMotion));
static_assert(same(BusFault::kStrokeStuck, Fault::kStrokeStuck));
static_assert(same(BusFault::kStrokeJump, Fault::kStrokeJump));
static_assert(same(BusFault::kPressureImplausible, Fault::kPressureImplausible));
static_assert(same(BusFault::kSwashDisagrees, Fault::kSwashDisagrees));
static_assert(same(BusFault::kMemoryCorrupt, Fault::kMemoryCorrupt));
static_assert(same(BusFault::kValveNotFollowing, Fault::kValveNotFollowing));
static_assert(same(BusFault::kValueOutOfRange, Fault::kValueOutOfRange));
static_assert(same(BusFault::kSensorError, Fault::kSensorError));
static_assert(same(BusFault::kPoseMissing, Fault::kPoseMissing));
static_assert(same(BusFault::kPoseImplausible, Fault::kPoseImplausible));
static_assert(same(BusFault::kTransmissionMissing, Fault::kTransmissionMissing));
static_assert(same(BusFault::kDisplacementDisagrees, Fault::kDisplacementDisagrees));
static_assert(same(BusFault::kDisplacementRunaway, Fault::kDisplacementRunaway));
static_assert(same(BusFault::kTrackSpeedDisagrees, Fault::kTrackSpeedDisagrees));
static_assert(bus::EcuStatus::kFault.raw_max == kFaultCount - 1);
// For LimitKind::kDegraded the index is a fault's number.
static_assert(bus::EcuStatus::kLimitIndex.raw_max >= kFaultCount - 1);
// Every reason has its bit.
static_assert(bus::EcuHealth::kWhyNotArmed.raw_max >> static_cast<unsigned>(ArmBlock::kStopping) ==
              1U);

constexpr dbc::Physical physical(double value) { return {value, RawState::kValid}; }
constexpr dbc::Count count(std::uint32_t value) { return {value, RawState::kValid}; }

template <class Bus, class Own>
constexpr dbc::Coded<Bus> coded(Own own_code) {
  return {static_cast<Bus>(own_code), RawState::kValid};
}

bool may_move(const ExcavatorOutputs& outputs) {
  bool finite = true;
  for (const double duty_ratio : outputs.duty_ratio) {
    finite = finite && std::isfinite(duty_ratio);
  }
  return outputs.enable && finite;
}

bus::SpoolCommand spool_command(const ExcavatorOutputs& outputs, const EcuDiagnosis&) {
  bus::SpoolCommand message;  // its start values are Off, neutral and no cut
  if (!outputs.pilot_known) {
    message.pilot_cut.state = RawState::kNotAvailable;
  } else if (outputs.pilot_cut) {
    message.pilot_cut = coded<bus::SpoolCommand::PilotCut>(bus::SpoolCommand::PilotCut::kOn);
  }
  if (may_move(outputs)) {
    message.enable = coded<bus::SpoolCommand::Enable>(bus::SpoolCommand::Enable::kOn);
    message.boom_duty_ratio = physical(outputs.duty_ratio[0]);
    message.arm_duty_ratio = physical(outputs.duty_ratio[1]);
    message.bucket_duty_ratio = physical(outputs.duty_ratio[2]);
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

std::uint32_t non_negative(TimeUs time_us) {
  const TimeUs low = time_us < 0 ? 0 : time_us;
  return low > UINT32_MAX ? UINT32_MAX : static_cast<std::uint32_t>(low);
}

bus::EcuStatus ecu_status(const ExcavatorOutputs& outputs, const EcuDiagnosis& diagnosis) {
  const ExcavatorStatus& status = outputs.status;
  bus::EcuStatus message;
  message.mode = coded<BusMode>(status.mode);
  message.limit_kind = coded<BusLimit>(status.limit.kind);
  message.limit_index = count(status.limit.index);
  message.lambda = physical(status.lambda);
  message.fault = coded<BusFault>(status.fault);
  message.cycle_time_us = count(non_negative(diagnosis.cycle_time_us));
  message.rejected_frames = count(diagnosis.rejected_frames);
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

bus::EcuIdentity ecu_identity(const ExcavatorOutputs&, const EcuDiagnosis& diagnosis) {
  bus::EcuIdentity message;
  message.profile_hash = count(diagnosis.profile_hash);
  message.dbc_version = count(bus::kDbcVersion);
  return message;
}

bus::EcuHealth ecu_health(const ExcavatorOutputs& outputs, const EcuDiagnosis& diagnosis) {
  const ProcessHealth& process = diagnosis.process;
  bus::EcuHealth message;
  message.why_not_armed = count(outputs.status.why_not_armed);
  message.allocations = count(process.allocations);
  message.page_faults = count(process.page_faults);
  message.overruns = count(process.overruns);
  message.dropped_frames = count(diagnosis.dropped_frames);
  message.real_time = coded<bus::EcuHealth::RealTime>(process.real_time ? 1 : 0);
  return message;
}

bus::DM1 trouble(const Dm1Content& content) {
  bus::DM1 message;
  message.amber_warning_lamp = coded<bus::DM1::AmberWarningLamp>(content.amber_warning ? 1 : 0);
  message.red_stop_lamp = coded<bus::DM1::RedStopLamp>(content.red_stop ? 1 : 0);
  message.spn_low = count(content.spn & 0xFFFFU);
  message.spn_high = count(content.spn >> 16U);
  message.fmi = count(content.fmi);
  message.occurrence_count = count(content.occurrences);
  return message;
}
static_assert(kDm1FirstSpn + kFaultCount <= 524288U);

struct Row {
  std::uint32_t id = 0;
  TimeUs period_us = 0;
  TimeUs phase_us = 0;  ///< Spreads the load: no cycle sends all.
  bool is_protected = false;
  std::uint16_t data_id = 0;
  dbc::Payload (*encode)(const ExcavatorOutputs&, const EcuDiagnosis&) = nullptr;
};

template <auto make>
dbc::Payload encode(const ExcavatorOutputs& outputs, const EcuDiagnosis& diagnosis) {
  return make(outputs, diagnosis).encode();
}

template <class Message, Message (*make)(const ExcavatorOutputs&, const EcuDiagnosis&)>
constexpr Row row(TimeUs phase_us) {
  static_assert(Message::kLength == 8);
  return {Message::kId,     Message::kCycleTimeMs * kMillisecondUs,
          phase_us,         Message::kProtected,
          Message::kDataId, &encode<make>};
}

constexpr TimeUs kControlPeriodUs = 10 * kMillisecondUs;

constexpr std::array<Row, ExcavatorTransmitter::kPeriodicCount> kRows{{
    row<bus::SpoolCommand, spool_command>(0),
    row<bus::PumpCommand, pump_command>(0),
    row<bus::EcuStatus, ecu_status>(0),
    row<bus::EcuMotion, ecu_motion>(kControlPeriodUs),
    row<bus::EcuHydraulics, ecu_hydraulics>(kControlPeriodUs),
    row<bus::EcuHealth, ecu_health>(5 * kControlPeriodUs),
    row<bus::EcuIdentity, ecu_identity>(0),
}};

constexpr TimeUs kSlackUs = kControlPeriodUs / 2;

/// Whether a message is due, and when it is next.
bool take_due(TimeUs& due_us, TimeUs period_us, TimeUs now) {
  const TimeUs late_us = now - due_us;
  const bool clock_went_back = late_us < -(period_us + kControlPeriodUs);
  if (late_us < -kSlackUs && !clock_went_back) {
    return false;
  }
  const bool on_schedule = !clock_went_back && late_us <= kSlackUs;
  due_us = (on_schedule ? due_us : now) + period_us;
  return true;
}

CanFrame frame_of(std::uint32_t id, const dbc::Payload& payload, TimeUs now) {
  CanFrame frame;
  frame.id = id;
  frame.length = 8;
  frame.data = payload;
  frame.stamp_us = now;
  return frame;
}

}  // namespace

int ExcavatorTransmitter::frames(const ExcavatorOutputs& outputs, const EcuDiagnosis& diagnosis,
                                 TimeUs now, Frames& out) {
  if (!started_) {
    started_ = true;
    for (std::size_t i = 0; i < kRows.size(); ++i) {
      due_us_[i] = now + kRows[i].phase_us;
    }
  }
  std::size_t written = 0;
  for (std::size_t i = 0; i < kRows.size(); ++i) {
    const Row& row = kRows[i];
    if (!take_due(due_us_[i], row.period_us, now)) {
      continue;
    }
    CanFrame frame = frame_of(row.id, row.encode(outputs, diagnosis), now);
    if (row.is_protected) {
      e2e_protect(frame.data, row.data_id, counter_[i]);
      counter_[i] = e2e_next_counter(counter_[i]);
    }
    out[written++] = frame;
  }
  Dm1Content content;
  if (dm1_.due(outputs.status.faults, now, content)) {
    out[written++] = frame_of(bus::DM1::kId, trouble(content).encode(), now);
  }
  return static_cast<int>(written);
}

}  // namespace graben
