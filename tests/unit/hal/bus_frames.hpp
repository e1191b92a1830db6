#pragma once
/// Frames that the receiver takes, for its tests.

#include "can_dbc/generated/excavator_dbc.hpp"
#include "hal/excavator_receiver.hpp"
#include "tests/unit/cmocka_cpp.hpp"

namespace graben::test {

namespace bus = dbc::excavator;

inline constexpr TimeUs kStartUs = 5'000'000;

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
using Protected =
    List<bus::BoomStroke, bus::ArmStroke, bus::BucketStroke, bus::BoomPressure, bus::ArmPressure,
         bus::BucketPressure, bus::PumpState, bus::OperatorCommand, bus::ValveState>;
using Unprotected = List<bus::EEC1, bus::MachineIdentity>;

template <class Test, class... Messages>
void for_each(List<Messages...>, Test test) {
  (test(Messages{}), ...);
}

// A message whose every value is valid and distinct from its start value.
template <class Message>
Message filled(std::uint32_t raw) {
  Message message;
  Message::visit(message, [raw](const dbc::Field& field, auto& signal) {
    dbc::from_raw(field, field.raw_min + (field.width >= 16 ? raw : 1U), signal);
  });
  return message;
}

// Brings the link to acceptance with counters 0, 1, 2; returns the time of the last frame.
template <class Message>
TimeUs synchronise(ExcavatorReceiver& receiver) {
  TimeUs now = kStartUs;
  for (std::uint8_t counter = 0; counter < 3; ++counter) {
    now += Message::kCycleTimeMs * kMillisecondUs;
    receiver.accept(frame_of(filled<Message>(1000), counter), now);
  }
  return now;
}

}  // namespace graben::test
