// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Frames that the receivers take, for their tests, and what the tests need to know of each bus.

#include "can_dbc/generated/dozer_dbc.hpp"
#include "can_dbc/generated/excavator_dbc.hpp"
#include "hal/buses/dozer_bus.hpp"
#include "hal/buses/excavator_bus.hpp"
#include "tests/unit/cmocka_cpp.hpp"

namespace graben::test {

inline constexpr TimeUs kFirstFrameUs = 5'000'000;

template <class Message>
CanFrame frame_of(const Message& message, std::uint8_t counter) {
  CanFrame frame;
  frame.id = Message::kId;
  frame.length = Message::kLength;
  frame.data = message.encode();
  if (Message::kProtected) {
    e2e_protect(frame.data, Message::kDataId, counter);
  }
  return frame;
}

// The messages as types, so that every test runs over all that are received.
template <class... Messages>
struct List {};

// A receiver or transmitter of a machine with every part that its bus knows of.
template <class End>
struct WithAllParts : End {
  WithAllParts() : End(all_parts()) {}

  [[nodiscard]] static BusParts all_parts() {
    BusParts parts{true};
    parts.second_strokes = true;
    parts.second_swing = true;
    return parts;
  }
};

// Raw value that a test gives to a field: valid and distinct from its start value.
inline std::uint32_t filled_raw(const dbc::Field& field, std::uint32_t raw) {
  return field.width >= 16 ? field.raw_min + raw : field.raw_max;
}

// A message whose every value is valid and distinct from its start value.
template <class Message>
Message filled(std::uint32_t raw) {
  Message message;
  Message::visit(message, [raw](const dbc::Field& field, auto& signal) {
    dbc::from_raw(field, filled_raw(field, raw), signal);
  });
  return message;
}

// The operator's frame to a dozer: the same message, its task one of a dozer's.
struct DozerCommand : dbc::dozer::OperatorCommand {};
template <>
inline DozerCommand filled<DozerCommand>(std::uint32_t raw) {
  DozerCommand command{filled<dbc::dozer::OperatorCommand>(raw)};
  command.task.value = DozerCommand::Task::kGrade;
  return command;
}

// `Other` are messages that a sender could send under the id of Stroke.
struct ExcavatorBus {
  using Receiver = WithAllParts<ExcavatorReceiver>;
  using Transmitter = ExcavatorTransmitter;
  using MachineIdentity = dbc::excavator::MachineIdentity;
  static constexpr std::uint8_t kDbcVersion = dbc::excavator::kDbcVersion;
  static constexpr auto kTask = dbc::excavator::OperatorCommand::Task::kDig;
  static constexpr double kTaskSeen = 1.0;
  using Stroke = dbc::excavator::BoomStroke;
  using SpoolCommand = dbc::excavator::SpoolCommand;
  using OperatorCommand = dbc::excavator::OperatorCommand;
  using Protected =
      List<dbc::excavator::BoomStroke, dbc::excavator::ArmStroke, dbc::excavator::BucketStroke,
           dbc::excavator::BoomPressure, dbc::excavator::ArmPressure,
           dbc::excavator::BucketPressure, dbc::excavator::PumpState,
           dbc::excavator::OperatorCommand, dbc::excavator::ValveState, dbc::excavator::SwingState,
           dbc::excavator::SwingValveState, dbc::excavator::OperatorAxes,
           dbc::excavator::CommissionDuty, dbc::excavator::CommissionWindow,
           dbc::excavator::SecondStrokes, dbc::excavator::SecondSwing, dbc::excavator::TouchedPoint,
           dbc::excavator::ExternalLimit>;
  using Unprotected = List<dbc::excavator::EEC1, dbc::excavator::MachineIdentity>;
  using Other = List<dbc::excavator::ArmStroke, dbc::excavator::ValveState,
                     dbc::excavator::SpoolCommand, dbc::excavator::PumpCommand>;
};

struct DozerBus {
  using Receiver = DozerReceiver;
  using Transmitter = DozerTransmitter;
  using MachineIdentity = dbc::dozer::MachineIdentity;
  static constexpr std::uint8_t kDbcVersion = dbc::dozer::kDbcVersion;
  static constexpr auto kTask = dbc::dozer::OperatorCommand::Task::kGrade;
  static constexpr double kTaskSeen = 2.0;
  using Stroke = dbc::dozer::BladeStroke;
  using SpoolCommand = dbc::dozer::SpoolCommand;
  using OperatorCommand = DozerCommand;
  using Protected =
      List<dbc::dozer::BladeStroke, dbc::dozer::BodyPosition, dbc::dozer::BodyPitch,
           dbc::dozer::BodyVelocity, dbc::dozer::LeftTransmission, dbc::dozer::RightTransmission,
           dbc::dozer::TrackSpeed, dbc::dozer::TiltState, dbc::dozer::BodyCourse, DozerCommand,
           dbc::dozer::ValveState, dbc::dozer::TouchedPoint, dbc::dozer::ExternalLimit,
           dbc::dozer::DozerTry, dbc::dozer::DozerWindow>;
  using Unprotected = List<dbc::dozer::EEC1, dbc::dozer::MachineIdentity>;
  using Other = List<dbc::dozer::BodyPitch, dbc::dozer::ValveState, dbc::dozer::SpoolCommand,
                     dbc::dozer::MotorDisplacementCommand>;
};

template <class... Messages>
constexpr int count_of(List<Messages...>) {
  return static_cast<int>(sizeof...(Messages));
}

template <class Test, class... Messages>
void for_each(List<Messages...>, Test test) {
  (test(Messages{}), ...);
}

// A protected or plain frame whose field carries `raw`.
template <class Message>
CanFrame frame_with(const dbc::Field& field, std::uint32_t raw, std::uint8_t counter) {
  CanFrame frame = frame_of(filled<Message>(2000), counter);
  dbc::insert(frame.data, field.start_bit, field.width, raw);
  if (Message::kProtected) {
    e2e_protect(frame.data, Message::kDataId, counter);
  }
  return frame;
}

// Brings the link to acceptance with counters 0, 1, 2; returns the time of the last frame.
template <class Message, class Receiver>
TimeUs synchronise(Receiver& receiver) {
  TimeUs now = kFirstFrameUs;
  for (std::uint8_t counter = 0; counter < 3; ++counter) {
    now += Message::kCycleTimeMs * kMillisecondUs;
    receiver.accept(frame_of(filled<Message>(1000), counter), now);
  }
  return now;
}

template <class T>
void assert_signal(const Signal<T>& signal, double value, TimeUs stamp_us) {
  assert_int_equal(signal.validity, Validity::kValid);
  assert_near(static_cast<double>(signal.value), value, 1e-9 * std::fabs(value));
  assert_int_equal(signal.stamp_us, stamp_us);
}

// `lost`, which this field says, is lost by either raw value that says so, and `stays` is not.
template <class Message, class Receiver>
void check_lost(Receiver& receiver, const dbc::Field& field,
                const std::array<std::uint32_t, 2>& error_and_not_available,
                const Signal<double>& lost, const Signal<double>& stays) {
  TimeUs now = synchronise<Message>(receiver);
  std::uint8_t counter = 3;
  for (const std::uint32_t raw : error_and_not_available) {
    const bool error = raw == error_and_not_available[0];
    now += 10'000;
    receiver.accept(frame_with<Message>(field, raw, counter++), now);
    assert_int_equal(lost.validity, error ? Validity::kError : Validity::kNotAvailable);
    assert_near(lost.value, 0.0, 0.0);
    assert_int_equal(lost.stamp_us, now);
    assert_int_equal(stays.validity, Validity::kValid);
  }
  assert_int_equal(rejected(receiver.total()), 0);
}

// Gives a receiver a message until it is taken, each at times of its own.
template <class Receiver>
struct Feed {
  Receiver receiver;
  TimeUs start_us = kFirstFrameUs;

  // Stamp of the frame that was taken last.
  template <class Message>
  TimeUs send(const Message& message) {
    TimeUs now = ++start_us;
    receiver.accept(frame_of(message, 0), now);
    for (std::uint8_t counter = 1; counter < 3; ++counter) {
      now += Message::kCycleTimeMs * kMillisecondUs;
      receiver.accept(frame_of(message, counter), now);
    }
    return now;
  }
};

}  // namespace graben::test
