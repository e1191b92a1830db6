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
static_assert(same(bus::EcuStatus::kLimitKind.raw_max, LimitKind::kRise));

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
static_assert(same(bus::EcuStatus::kFault.raw_max, Fault::kIdentityMismatch));

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
  bus::SpoolCommand message;  // its start values are Off and neutral
  if (may_move(outputs)) {
    message.enable = coded<bus::SpoolCommand::Enable>(bus::SpoolCommand::Enable::kOn);
    message.boom_duty_ratio = physical(outputs.duty_ratio[0]);
    message.arm_duty_ratio = physical(outputs.duty_ratio[1]);
    message.bucket_duty_ratio = physical(outputs.duty_ratio[2]);
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

struct Row {
  std::uint32_t id = 0;
  std::uint8_t length = 0;
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
  return {Message::kId, Message::kLength,    Message::kCycleTimeMs * kMillisecondUs,
          phase_us,     Message::kProtected, Message::kDataId,
          &encode<make>};
}

constexpr TimeUs kControlPeriodUs = 10 * kMillisecondUs;

constexpr std::array<Row, ExcavatorTransmitter::kMessageCount> kRows{{
    row<bus::SpoolCommand, spool_command>(0),
    row<bus::EcuStatus, ecu_status>(0),
    row<bus::EcuMotion, ecu_motion>(kControlPeriodUs),
    row<bus::EcuHydraulics, ecu_hydraulics>(kControlPeriodUs),
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
    CanFrame frame;
    frame.id = row.id;
    frame.length = row.length;
    frame.stamp_us = now;
    frame.data = row.encode(outputs, diagnosis);
    if (row.is_protected) {
      e2e_protect(frame.data, row.data_id, counter_[i]);
      counter_[i] = e2e_next_counter(counter_[i]);
    }
    out[written++] = frame;
  }
  return static_cast<int>(written);
}

}  // namespace graben
