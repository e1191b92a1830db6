#pragma once
/// How a receiver's table comes of the types of its messages, and what every kind's bus carries.

#include "firmware/signals/machine_signals.hpp"
#include "hal/link/message_receiver.hpp"

namespace graben {

constexpr Validity validity_of(dbc::RawState state) {
  switch (state) {
    case dbc::RawState::kValid:
      return Validity::kValid;
    case dbc::RawState::kError:
      return Validity::kError;
    case dbc::RawState::kNotAvailable:
      return Validity::kNotAvailable;
    case dbc::RawState::kOutOfRange:
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

template <class OperatorCommand>
void put_driver(OperatorInputs& driver, const OperatorCommand& message, TimeUs now) {
  using Mode = typename OperatorCommand::OperatorMode;
  static_assert(static_cast<int>(Mode::kManual) == static_cast<int>(OperatorMode::kManual));
  static_assert(static_cast<int>(Mode::kAutomatic) == static_cast<int>(OperatorMode::kAutomatic));
  static_assert(OperatorCommand::kOperatorMode.raw_max ==
                static_cast<unsigned>(OperatorMode::kAutomatic));
  using BusTask = typename OperatorCommand::Task;
  static_assert(static_cast<int>(BusTask::kNone) == static_cast<int>(Task::kNone));
  static_assert(static_cast<int>(BusTask::kDig) == static_cast<int>(Task::kDig));
  put(driver.enable, message.enable, now);
  put(driver.mode, message.operator_mode, now);
  put(driver.task, message.task, now);
  put(driver.speed_override_ratio, message.speed_override_ratio, now);
}

template <class MachineIdentity>
void put_identity(PartnerIdentity& identity, const MachineIdentity& message, TimeUs now) {
  put(identity.profile_hash, message.profile_hash, now);
  put(identity.dbc_version, message.dbc_version, now);
}

/// Whether every value is one that its signal may have.
template <class Message>
bool in_range(const Message& message) {
  bool all = true;
  Message::visit(message, [&all](const dbc::Field&, const auto& signal) {
    all = all && signal.state != dbc::RawState::kOutOfRange;
  });
  return all;
}

/// Decodes and stores a payload; false, and nothing stored, if a value is out of range.
/// `Store::is_ours` says whether this kind of machine can be meant by what is in range;
/// `Store::store` puts the signals into their places, `Store::part` says what part of a machine a
/// message belongs to.
template <class Inputs, class Store, class Message>
bool decode(const dbc::Payload& payload, TimeUs now, Received<Inputs>& to) {
  const Message message = Message::decode(payload);
  const bool usable = in_range(message) && Store::is_ours(message);
  if (usable) {
    Store::store(message, now, to);
  }
  return usable;
}

/// The table of a bus of which `Messages` are received.
template <class Inputs, class Store, class... Messages, std::size_t all_count>
constexpr auto receive_table(dbc::MessageList<Messages...>,
                             const std::array<dbc::MessageInfo, all_count>& all,
                             std::uint8_t dbc_version) {
  return ReceiveTable<Inputs, sizeof...(Messages)>{
      {message_rule<Messages>(Store::part(Messages{}))...},
      {&decode<Inputs, Store, Messages>...},
      all.data(),
      all_count,
      dbc_version};
}

}  // namespace graben
