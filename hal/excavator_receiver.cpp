#include "hal/excavator_receiver.hpp"

#include <algorithm>

#include "can_dbc/generated/excavator_dbc.hpp"

namespace graben {
namespace {

namespace bus = dbc::excavator;
using dbc::RawState;
using Received = ExcavatorReceiver::Received;

static_assert(static_cast<int>(bus::OperatorCommand::OperatorMode::kManual) ==
              static_cast<int>(OperatorMode::kManual));
static_assert(static_cast<int>(bus::OperatorCommand::OperatorMode::kAutomatic) ==
              static_cast<int>(OperatorMode::kAutomatic));
static_assert(bus::OperatorCommand::kOperatorMode.raw_max ==
              static_cast<unsigned>(OperatorMode::kAutomatic));
static_assert(static_cast<int>(bus::OperatorCommand::Task::kNone) == static_cast<int>(Task::kNone));
static_assert(static_cast<int>(bus::OperatorCommand::Task::kDig) == static_cast<int>(Task::kDig));
static_assert(bus::OperatorCommand::kTask.raw_max == static_cast<unsigned>(Task::kDig));

constexpr Validity validity_of(RawState state) {
  switch (state) {
    case RawState::kValid:
      return Validity::kValid;
    case RawState::kError:
      return Validity::kError;
    case RawState::kNotAvailable:
      return Validity::kNotAvailable;
    case RawState::kOutOfRange:
      break;
  }
  return Validity::kOutOfRange;
}

/// The codec gives 0 for what is not valid, so that nobody goes on with the last good value.
template <class T, class Raw>
void put(Signal<T>& signal, const Raw& raw, TimeUs now) {
  signal.validity = validity_of(raw.state);
  signal.value = static_cast<T>(raw.value);
  signal.stamp_us = now;
}

void put_pressures(AxisInputs& axis, const dbc::Physical& cap, const dbc::Physical& rod,
                   TimeUs now) {
  put(axis.cap_pressure_pa, cap, now);
  put(axis.rod_pressure_pa, rod, now);
}

void store(const bus::BoomStroke& message, TimeUs now, Received& to) {
  put(to.inputs.axis[0].stroke_m, message.boom_stroke_m, now);
}

void store(const bus::ArmStroke& message, TimeUs now, Received& to) {
  put(to.inputs.axis[1].stroke_m, message.arm_stroke_m, now);
}

void store(const bus::BucketStroke& message, TimeUs now, Received& to) {
  put(to.inputs.axis[2].stroke_m, message.bucket_stroke_m, now);
}

void store(const bus::BoomPressure& message, TimeUs now, Received& to) {
  put_pressures(to.inputs.axis[0], message.boom_cap_pressure_pa, message.boom_rod_pressure_pa, now);
}

void store(const bus::ArmPressure& message, TimeUs now, Received& to) {
  put_pressures(to.inputs.axis[1], message.arm_cap_pressure_pa, message.arm_rod_pressure_pa, now);
}

void store(const bus::BucketPressure& message, TimeUs now, Received& to) {
  put_pressures(to.inputs.axis[2], message.bucket_cap_pressure_pa, message.bucket_rod_pressure_pa,
                now);
}

void store(const bus::PumpState& message, TimeUs now, Received& to) {
  put(to.inputs.swash_ratio[0], message.pump1_swash_ratio, now);
  put(to.inputs.swash_ratio[1], message.pump2_swash_ratio, now);
}

void store(const bus::EEC1& message, TimeUs now, Received& to) {
  put(to.inputs.engine_speed_radps, message.engine_speed_radps, now);
}

void store(const bus::OperatorCommand& message, TimeUs now, Received& to) {
  OperatorInputs& driver = to.inputs.driver;
  put(driver.enable, message.enable, now);
  put(driver.mode, message.operator_mode, now);
  put(driver.task, message.task, now);
  put(driver.speed_override_ratio, message.speed_override_ratio, now);
}

void store(const bus::MachineIdentity& message, TimeUs now, Received& to) {
  put(to.identity.profile_hash, message.profile_hash, now);
  put(to.identity.dbc_version, message.dbc_version, now);
}

void store(const bus::ValveState& message, TimeUs now, Received& to) {
  put(to.inputs.axis[0].spool_ratio, message.boom_spool_ratio, now);
  put(to.inputs.axis[1].spool_ratio, message.arm_spool_ratio, now);
  put(to.inputs.axis[2].spool_ratio, message.bucket_spool_ratio, now);
  put(to.inputs.valve_enabled, message.enabled, now);
}

/// Decodes and stores a payload; false, and nothing stored, if a value is out of range.
template <class Message>
bool decode(const dbc::Payload& payload, TimeUs now, Received& to) {
  const Message message = Message::decode(payload);
  bool in_range = true;
  Message::visit(message, [&in_range](const dbc::Field&, const auto& signal) {
    in_range = in_range && signal.state != RawState::kOutOfRange;
  });
  if (in_range) {
    store(message, now, to);
  }
  return in_range;
}

struct Row {
  std::uint32_t id = 0;
  std::uint8_t length = 0;
  bool is_protected = false;
  E2eConfig e2e;
  bool (*decode)(const dbc::Payload&, TimeUs, Received&) = nullptr;
};

/// One cycle more than the counter may skip: then the counter alone would refuse the frame, and it
/// is far below the 15 cycles after which it would not.
template <class Message>
constexpr Row row() {
  constexpr TimeUs kMaxSilenceUs =
      (Message::kMaxDeltaCounter + 1) * Message::kCycleTimeMs * kMillisecondUs;
  return {Message::kId, Message::kLength, Message::kProtected,
          E2eConfig{Message::kDataId, Message::kMaxDeltaCounter, kMaxSilenceUs,
                    Message::kCycleTimeMs * kMillisecondUs},
          &decode<Message>};
}

constexpr std::array<Row, ExcavatorReceiver::kMessageCount> kRows{{
    row<bus::BoomStroke>(),
    row<bus::ArmStroke>(),
    row<bus::BucketStroke>(),
    row<bus::BoomPressure>(),
    row<bus::ArmPressure>(),
    row<bus::BucketPressure>(),
    row<bus::PumpState>(),
    row<bus::EEC1>(),
    row<bus::OperatorCommand>(),
    row<bus::MachineIdentity>(),
    row<bus::ValveState>(),
}};

constexpr int kNoRow = -1;

int row_of(std::uint32_t id) {
  for (std::size_t i = 0; i < kRows.size(); ++i) {
    if (kRows[i].id == id) {
      return static_cast<int>(i);
    }
  }
  return kNoRow;
}

void increment(std::uint32_t& counter) {
  if (counter < UINT32_MAX) {
    ++counter;
  }
}

std::uint32_t LinkCounters::*counter_of(E2eCheck check) {
  switch (check) {
    case E2eCheck::kSynchronising:
      return &LinkCounters::synchronising;
    case E2eCheck::kWrongCrc:
      return &LinkCounters::wrong_crc;
    case E2eCheck::kRepeated:
    case E2eCheck::kWrongSequence:
    case E2eCheck::kConflict:
    case E2eCheck::kTooMany:
    case E2eCheck::kNoNewData:
    case E2eCheck::kOk:
    case E2eCheck::kSomeLost:
      break;
  }
  return &LinkCounters::wrong_counter;
}

E2eMark mark_of(E2eCheck check) {
  return e2e_accepted(check) || check == E2eCheck::kSynchronising ? E2eMark::kGood
                                                                  : E2eMark::kSequence;
}

/// Whether the CRC is that of any protected message of the bus.
bool is_any_message(const CanFrame& frame) {
  bool fits = false;
  for (const dbc::MessageInfo& message : bus::kMessages) {
    fits = fits || (message.is_protected && e2e_crc_fits(frame.data, message.data_id));
  }
  return fits;
}

}  // namespace

void ExcavatorReceiver::count(std::size_t row, std::uint32_t LinkCounters::*counter) {
  increment(link_[row].*counter);
  increment(total_.*counter);
}

bool ExcavatorReceiver::passes_e2e(std::size_t row, const CanFrame& frame, TimeUs now) {
  const E2eCheck check = e2e_check(kRows[row].e2e, e2e_[row], frame.data, now);
  if (check == E2eCheck::kWrongCrc && is_any_message(frame)) {
    e2e_note(window_[row], E2eMark::kMasquerade, now);
    count(row, &LinkCounters::masquerade);
    return false;
  }
  if (check == E2eCheck::kWrongCrc) {
    e2e_note(window_[row], E2eMark::kCorrupt, now);
  } else if (check != E2eCheck::kRepeated) {
    e2e_note(window_[row], mark_of(check), now);
  }
  if (!e2e_accepted(check)) {
    count(row, counter_of(check));
    return false;
  }
  return true;
}

std::array<std::uint32_t, ExcavatorReceiver::kMessageCount> ExcavatorReceiver::ids() {
  std::array<std::uint32_t, kMessageCount> ids{};
  std::transform(kRows.begin(), kRows.end(), ids.begin(), [](const Row& row) { return row.id; });
  return ids;
}

void ExcavatorReceiver::accept(const CanFrame& frame, TimeUs now) {
  if (frame.error) {
    increment(total_.wrong_kind);
    return;
  }
  const int index = row_of(frame.id);
  if (index == kNoRow) {
    increment(foreign_);
    return;
  }
  const auto i = static_cast<std::size_t>(index);
  const Row& row = kRows[i];
  if (!frame.extended || frame.remote || frame.fd) {
    count(i, &LinkCounters::wrong_kind);
    return;
  }
  if (frame.length != row.length) {
    count(i, &LinkCounters::wrong_length);
    return;
  }
  if (row.is_protected && !passes_e2e(i, frame, now)) {
    return;
  }
  const bool in_range = row.decode(frame.data, now, received_);
  count(i, in_range ? &LinkCounters::accepted : &LinkCounters::out_of_range);
  out_of_range_ = out_of_range_ || !in_range;
}

FaultSet ExcavatorReceiver::message_faults(TimeUs now) const {
  FaultSet faults;
  for (const E2eWindow& window : window_) {
    faults.add(e2e_faults(window, now));
  }
  return faults;
}

bool ExcavatorReceiver::take_out_of_range() {
  const bool was_out_of_range = out_of_range_;
  out_of_range_ = false;
  return was_out_of_range;
}

Signal<bool> same_machine(const ExcavatorIdentity& identity, std::uint32_t own_profile_hash) {
  const auto& [hash, version] = identity;
  return {hash.value == own_profile_hash && version.value == bus::kDbcVersion,
          std::min(hash.validity, version.validity), std::min(hash.stamp_us, version.stamp_us)};
}

LinkCounters ExcavatorReceiver::link(std::uint32_t id) const {
  const int index = row_of(id);
  return index == kNoRow ? LinkCounters{} : link_[static_cast<std::size_t>(index)];
}

E2eCheck ExcavatorReceiver::link_check(std::uint32_t id, TimeUs now) const {
  const int index = row_of(id);
  if (index == kNoRow) {
    return E2eCheck::kNoNewData;
  }
  const auto i = static_cast<std::size_t>(index);
  return e2e_status(kRows[i].e2e, e2e_[i], now);
}

}  // namespace graben
