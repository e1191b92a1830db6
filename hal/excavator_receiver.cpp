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
          E2eConfig{Message::kDataId, Message::kMaxDeltaCounter, kMaxSilenceUs}, &decode<Message>};
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
    case E2eCheck::kWrongCrc:
      return &LinkCounters::wrong_crc;
    case E2eCheck::kSynchronising:
      return &LinkCounters::synchronising;
    case E2eCheck::kRepeated:
    case E2eCheck::kWrongSequence:
    case E2eCheck::kNoNewData:
    case E2eCheck::kOk:
    case E2eCheck::kSomeLost:
      break;
  }
  return &LinkCounters::wrong_counter;
}

}  // namespace

void ExcavatorReceiver::count(int row, std::uint32_t LinkCounters::*counter) {
  increment(link_[static_cast<std::size_t>(row)].*counter);
  increment(total_.*counter);
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
  const Row& row = kRows[static_cast<std::size_t>(index)];
  if (!frame.extended || frame.remote || frame.fd) {
    count(index, &LinkCounters::wrong_kind);
    return;
  }
  if (frame.length != row.length) {
    count(index, &LinkCounters::wrong_length);
    return;
  }
  if (row.is_protected) {
    const E2eCheck check =
        e2e_check(row.e2e, e2e_[static_cast<std::size_t>(index)], frame.data, now);
    if (!e2e_accepted(check)) {
      count(index, counter_of(check));
      return;
    }
  }
  count(index, row.decode(frame.data, now, received_) ? &LinkCounters::accepted
                                                      : &LinkCounters::out_of_range);
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
